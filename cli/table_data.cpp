// SPDX-License-Identifier: MIT
// Settings: what a command works on, and how that is read.
#include "cli/parse.h"
#include "cli/tables.h"
#include "libtrack/error.h"
#include "libtrack/read/read.h"

namespace swarmfit::cli {
namespace {

constexpr Commands kReading = kDescribe | kConvert | kEvaluate | kFits;
constexpr std::string_view kHeading = "Reading";
constexpr int kLongestGap = 100000;                // frames
constexpr double kSlowest = 1e-9, kFastest = 1e9;  // frames per second

std::vector<Setting> inputs() {
  return {
      {.name = "DATA",
       .in = kDescribe | kConvert,
       .help = "recording: a file, - for standard input, or demo",
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.recordings = v.words; }},
      {.name = "DATA",
       .in = kFits,
       .help = "recordings: files, - for standard input, or demo; several are compared one by one and summarised",
       .allowed = texts(),
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.recordings = v.words; }},
      {.name = "REAL",
       .in = kEvaluate,
       .help = "the recording",
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.recordings = v.words; }},
      {.name = "SIM",
       .in = kEvaluate,
       .help = "what is compared with it; read with the same options",
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.simulated = v.text(); }},
      {.name = "TABLE",
       .in = kWeigh,
       .help = "CSV: a header of metric names, then one row per model, its name first",
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.table = v.text(); }},
      {.name = "RUN_DIR",
       .in = kResume,
       .help = "its run directory, started from the folder in which the run was started",
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.dir = v.text(); }},
      {.name = "RUN_DIR",
       .in = kReport,
       .help = "folder of a run that has finished",
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.dir = v.text(); }},
      {.name = "DIR",
       .in = kMerge,
       .help = "folders of all parts",
       .allowed = texts(),
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.dirs = v.words; }},
      {.name = "MODEL",
       .in = kSimulate,
       .help = "model with settings: bswarm, 'bswarm[noise=white]'; see swarmfit models",
       .required = true,
       .use = [](Arguments& a, const Value& v) { a.scene.model = v.text(); }},
      {.name = "NAME",
       .in = kModels,
       .help = "one model only, with its manual page",
       .use = [](Arguments& a, const Value& v) { a.name = v.text(); }},
      {.name = "model",
       .in = kComparisons,
       .help = "models, comma-separated, with settings in brackets: bswarm,boids,bswarm[noise=white]",
       .allowed = texts(),
       .letter = 'm',
       .use = [](Arguments& a, const Value& v) { a.compare.models = parse_models(v.words); }},
      {.name = "preset",
       .in = kCompare | kPower | kRecover,
       .help = "noise: bswarm with its four noises; ablation: bswarm, without noise, without interaction; models: bswarm, noise_aware, "
               "boids, rvo, brownian and the null model langevin; all: these and every other model",
       .allowed = one_of({"noise", "ablation", "models", "all"}),
       .travels = false,  // as the models it stands for
       .use =
           [](Arguments& a, const Value& v) {
             if (v.all.has("model")) throw InputError("given beside --model; expected one of them, not both");
             a.compare.models = preset_models(v.text());
           }},
      {.name = "plant",
       .in = kRecover,
       .help = "models that make recordings; all that are compared if not given",
       .allowed = texts(),
       .use = [](Arguments& a, const Value& v) { a.recovery.planted = parse_models(v.words); }},
  };
}

std::vector<Setting> reading() {
  return {
      {.name = "columns",
       .in = kReading,
       .help = "what the columns hold: id,x,y,z,t,_,_ by position (_ skips), or id=object,t=time,x=X by header name",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.columns = v.text(); }},
      {.name = "delimiter",
       .in = kReading,
       .help = "column delimiter, if it is not found by itself",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.delimiter = parse_delimiter(v.text()); }},
      {.name = "fps",
       .in = kReading,
       .help = "frames per second, where the file does not tell",
       .allowed = above(kSlowest, kFastest),
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.fps = v.number(); }},
      {.name = "unit",
       .in = kReading,
       .help = "length unit, where the file does not tell: mm, m, px, ...",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.unit = v.text(); }},
      {.name = "var",
       .in = kReading,
       .help = "variable inside a container file (.mat)",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.variable = v.text(); }},
      {.name = "format",
       .in = kReading,
       .help = "file format, if it is not found by itself: see swarmfit formats",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.format = v.text(); }},
      {.name = "frames",
       .in = kReading,
       .help = "use frames a:b only, inclusive, in the file's numbering",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.frames = parse_interval("frames", v.text()); }},
      {.name = "times",
       .in = kReading,
       .help = "use times a:b only, inclusive [s]",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.times = parse_interval("times", v.text()); }},
      {.name = "kind",
       .in = kReading,
       .help = "use one kind of individual only, by name or number: sheep, or 0",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.kind = v.text(); }},
      {.name = "fill-gaps",
       .in = kReading,
       .help = "fill gaps of at most this many frames by linear interpolation",
       .allowed = whole(0, kLongestGap),
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.read.fill_gaps = v.whole<int>(); }},
      {.name = "sim-columns",
       .in = kEvaluate,
       .help = "columns of SIM, where they differ",
       .group = kHeading,
       .use = [](Arguments& a, const Value& v) { a.simulated_columns = v.text(); }},
  };
}

}  // namespace

std::vector<Setting> data_settings() {
  std::vector<Setting> all = inputs();
  for (Setting& s : reading()) all.push_back(std::move(s));
  return all;
}

}  // namespace swarmfit::cli
