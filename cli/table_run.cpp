// SPDX-License-Identifier: MIT
// Settings: how a command runs, and what it writes where.
#include "cli/most_threads.h"
#include "cli/parts.h"
#include "cli/tables.h"

namespace swarmfit::cli {
namespace {

constexpr double kLongest = 1e9;  // seconds, some thirty years
constexpr double kMostSeeds = 18446744073709551615.0;

void out(Arguments& a, const Value& v) { a.out = v.text(); }
void html(Arguments& a, const Value& v) { a.html = v.text(); }

}  // namespace

std::vector<Setting> run_settings() {
  return {
      {.name = "seed",
       .in = kAll & ~(kResume | kReport | kMerge),
       .help = "seed of all random numbers; the same seed gives the same bits",
       .allowed = whole(0, kMostSeeds),
       .initial = "1",
       .elsewhere = {kSimulate | kGallery, ""},  // those of the scenarios
       .use =
           [](Arguments& a, const Value& v) {
             a.common.seed = a.compare.seed = a.extending.pilot.seed = v.whole<std::uint64_t>();
             a.scene.seed = a.common.seed;
           }},
      {.name = "threads",
       .in = kAll & ~kReport,
       .help = "threads to use, 0 for all cores; never changes a result",
       .allowed = whole(0, kMostThreads),
       .travels = false,
       .use = [](Arguments& a, const Value& v) { a.common.threads = v.whole<int>(); }},
      {.name = "max-time",
       .in = kComparisons | kSweep | kResume,
       .help = "stop after this time, as Ctrl-C would; swarmfit resume continues: 90, 45min or 12h. Never changes a result",
       .allowed = time_up_to(kLongest),
       .travels = false,
       .use = [](Arguments& a, const Value& v) { a.max_time = v.number(); }},
      {.name = "part",
       .in = kStudies | kSweep | kResume,
       .help = "k/n: only every n-th recording or run of the study, from the k-th on; merge puts all n parts together",
       .travels = false,
       .use = [](Arguments& a, const Value& v) { a.part = parse_part(v.text()); }},
      {.name = "json",
       .in = kAll & ~kReport,
       .help = "print JSON instead of text",
       .allowed = on_or_off(),
       .travels = false,
       .use = [](Arguments& a, const Value& v) { a.common.json = v.on(); }},
      {.name = "quiet",
       .in = kAll & ~kReport,
       .help = "print neither progress nor remarks",
       .allowed = on_or_off(),
       .letter = 'q',
       .travels = false,
       .use = [](Arguments& a, const Value& v) { a.common.quiet = v.on(); }},
      {.name = "verbose",
       .in = kFits | kResume,
       .help = "print all tables and warnings, not the ranking alone",
       .allowed = on_or_off(),
       .travels = false,
       .use = [](Arguments& a, const Value& v) { a.common.verbose = v.on(); }},
      {.name = "quiet",
       .in = kReport,
       .help = "do not list what was written",
       .allowed = on_or_off(),
       .letter = 'q',
       .travels = false,
       .use = [](Arguments& a, const Value& v) { a.common.quiet = v.on(); }},
  };
}

std::vector<Setting> output_settings() {  // NOLINT(readability-function-size): a table
  return {
      {.name = "out",
       .in = kSyntheses,
       .help = "CSV file to write; every point says whether it was recorded (kind 0) or is synthetic; - for standard output",
       .letter = 'o',
       .use = out},
      {.name = "out", .in = kConvert, .help = "file to write; - for standard output", .letter = 'o', .required = true, .use = out},
      {.name = "to",
       .in = kConvert,
       .help = "format to write; by the ending of --out if not given: .csv, .h5, .npz, .sqlite, .pvd",
       .allowed = one_of({"csv", "hdf5", "npz", "jupedsim", "vtk"}),
       .use = [](Arguments& a, const Value& v) { a.write_as = v.text(); }},
      {.name = "out",
       .in = kSimulate,
       .help = "file to write: .csv, .h5, .npz, .sqlite or .pvd; - for standard output",
       .letter = 'o',
       .use = out},
      {.name = "out",
       .in = kFit | kCompare,
       .help = "run directory; swarmfit-<name of the data> if not given",
       .letter = 'o',
       .travels = false,
       .use = out},
      {.name = "out", .in = kPower, .help = "run directory; swarmfit-power if not given", .letter = 'o', .travels = false, .use = out},
      {.name = "out",
       .in = kRecover,
       .help = "run directory, with report.html to look at; swarmfit-recovery if not given",
       .letter = 'o',
       .travels = false,
       .use = out},
      {.name = "out", .in = kMeasure, .help = "run directory; swarmfit-measure if not given", .letter = 'o', .travels = false, .use = out},
      {.name = "out",
       .in = kSweep,
       .help = "run directory, with report.html to look at; swarmfit-sweep if not given",
       .letter = 'o',
       .travels = false,
       .use = out},
      {.name = "out", .in = kMerge, .help = "run directory of the whole", .letter = 'o', .required = true, .use = out},
      {.name = "out",
       .in = kReport,
       .help = "folder to write to, where files of the same names are replaced; RUN_DIR-paper if not given",
       .letter = 'o',
       .use = out},
      {.name = "format",
       .in = kReport,
       .help = "svg or pdf: the figures; tex or md: tables, methods and captions; csv: tables in full; html: the report; several separated "
               "by commas. pdf needs rsvg-convert (package librsvg2-bin)",
       .allowed = some_of({"svg", "pdf", "tex", "md", "csv", "html"}),
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.formats = v.words; }},
      {.name = "html", .in = kDescribe, .help = "also write a page: facts, warnings, the motion itself, distributions", .use = html},
      {.name = "html", .in = kEvaluate, .help = "also write a page: both in motion side by side, energies, distributions", .use = html},
      {.name = "html",
       .in = kSyntheses,
       .help = "page to write: the motion itself, recorded and synthetic points in two colours",
       .use = html},
      {.name = "html", .in = kSimulate, .help = "page to write: the motion itself, parameters, distributions", .use = html},
      {.name = "picture",
       .in = kSimulate,
       .help = "SVG file to write: the last frame, with the paths to it as fading tails",
       .use = [](Arguments& a, const Value& v) { a.picture = v.text(); }},
      {.name = "schema",
       .in = kScenarios,
       .help = "print the JSON schema of scenario files, for editors",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.schema = v.on(); }},
      {.name = "page",
       .in = kModels,
       .help = "its page of docs/models, as Markdown",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.page = v.on(); }},
      {.name = "scene",
       .in = kModels,
       .help = "the scenario that shows what it is known for, or its own name",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.flags = v.on(); }},
      {.name = "FORMAT",
       .in = kManual,
       .help = "man: a page for man; markdown: docs/reference/settings.md",
       .allowed = one_of({"man", "markdown"}),
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.name = v.text(); }},
      {.name = "SHELL",
       .in = kCompletion,
       .help = "whose completion to write: bash, zsh or fish",
       .allowed = one_of({"bash", "zsh", "fish"}),
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.name = v.text(); }},
      {.name = "FILE", .in = kGallery, .help = "page to write, such as gallery.html", .required = true, .use = out},
  };
}

}  // namespace swarmfit::cli
