// SPDX-License-Identifier: MIT
// The command line of swarmfit. The only file that includes CLI11, which takes long to compile.
#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>

#include "cli/cluster.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/parts.h"
#include "cli/version.h"
#include "libtrack/error.h"
#include "libtrack/memory.h"

namespace swarmfit::cli {
namespace {

void add_common(CLI::App& app, Common& common) {
  app.add_option("--seed", common.seed, "seed of every random number; same seed, same bits")->capture_default_str();
  app.add_option("--threads", common.threads, "threads to use, 0 for all cores; never changes a result")->check(CLI::NonNegativeNumber);
  app.add_flag("--json", common.json, "print JSON instead of text");
  app.add_flag("-q,--quiet", common.quiet, "no progress, no remarks");
}

void add_reading(CLI::App& app, DataArguments& data) {
  app.add_option("--columns", data.columns,
                 "what the columns hold: id,x,y,z,t,_,_ by position (_ skips), or id=object,t=time,x=X by header name");
  app.add_option("--delimiter", data.delimiter, "column delimiter, if it is not found by itself");
  app.add_option("--fps", data.fps, "frames per second, where the file does not tell")->check(CLI::PositiveNumber);
  app.add_option("--unit", data.unit, "length unit, where the file does not tell: mm, m, px, ...");
  app.add_option("--time-unit", data.time_unit,
                 "unit of bare numbers in a time column: ms, us, ns, min, h, d; seconds, where nothing tells");
  app.add_option("--dates", data.dates, "how to read 3/4/2021")->check(CLI::IsMember({"day-first", "month-first"}));
  app.add_option("--decimal", data.decimal, "whether 1,234 is a decimal or a thousand")->check(CLI::IsMember({"comma", "point"}));
  app.add_option("--missing", data.missing, "value that x and y have where nothing was seen: -1, 0, -999, ...");
  app.add_flag("--join", data.join,
               "the files of a folder, or of a pattern such as 'fish*.csv', are one recording and name its individuals");
  app.add_flag("--wide", data.wide, "several pairs of columns x, y are individuals, not points of one");
  app.add_option("--var", data.variable, "variable or part inside a container file, where there are several");
  app.add_option("--format", data.format, "file format, if it is not found by itself: see swarmfit formats");
  app.add_option("--node", data.node, "point of a posture that stands for the individual: its name, or mean");
  app.add_option("--min-confidence", data.min_confidence, "leave out points that the tracker is less sure of, 0 to 1")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--frames", data.frames, "use frames a:b only, inclusive, in the file's numbering");
  app.add_option("--times", data.times, "use times a:b only, inclusive [s]");
  app.add_option("--kind", data.kind, "use one kind of individual only, by name or number: sheep, or 0");
  app.add_option("--fill-gaps", data.fill_gaps, "fill gaps of at most this many frames by linear interpolation")
      ->check(CLI::NonNegativeNumber);
}

void add_data(CLI::App& app, DataArguments& data, const char* name, const char* help) {
  app.add_option(name, data.path, help)->required();
  add_reading(app, data);
}

void add_max_time(CLI::App& app, double& seconds) {
  app.add_option("--max-time", seconds,
                 "stop after this time as Ctrl-C would, so that swarmfit resume goes on: 90, 45min or 12h; no part of the result")
      ->transform(CLI::AsNumberWithUnit(std::map<std::string, double>{{"s", 1}, {"min", 60}, {"h", 3600}}))
      ->check(CLI::PositiveNumber);
}

void add_conditions(CLI::App& app, FitArguments& a) {
  app.add_option("--presence", a.presence, "who is there when: recorded, or constant (everybody of the first frame, throughout)")
      ->check(CLI::IsMember({"recorded", "constant"}))
      ->capture_default_str();
  app.add_option("--arena", a.arena, "open, box, sphere, or x0:x1,y0:y1[,z0:z1]")->capture_default_str();
  app.add_option("--population", a.population,
                 "how many individuals there were, where only part of the group was tracked: the rest is simulated unseen")
      ->check(CLI::PositiveNumber);
  app.add_option("--obs-noise", a.observation_error,
                 "localisation error put on simulated positions: estimate (default), or a value in length units");
  app.add_option(
      "--steps", a.steps,
      "simulation steps per frame: auto (default), as many per model as it takes until half the step changes no energy; fewest, as "
      "few as are stable; or a number. Models that decide once per frame take one");
}

void add_fit(CLI::App& app, FitArguments& a) {
  add_common(app, a.common);
  app.add_option("DATA", a.recordings, "recordings: files, - for standard input, or demo; several are compared one by one and summarised")
      ->required();
  add_reading(app, a.data);
  app.add_option("-m,--model", a.models, "models, comma-separated, with settings in brackets: bswarm,boids,bswarm[noise=white]");
  app.add_option("-o,--out", a.out, "run directory; swarmfit-<name of the data> if not given");
  app.add_option(
         "--protocol", a.protocol,
         "default, or ren2016, the paper's literal choices: z-scores of each set by itself, no localisation error or rounding, the "
         "fewest steps, all seven metrics, lag 1, the bare range for p2, pooled simulations, searches under the last weights, up to "
         "ten passes; flags given beside it win")
      ->check(CLI::IsMember({"default", "ren2016"}))
      ->capture_default_str();
  app.add_option("--budget", a.budget, "how long to search: quick, default or thorough")->capture_default_str();
  app.add_option("--max-evaluations", a.max_evaluations, "hard limit of candidates per model")->check(CLI::NonNegativeNumber);
  add_max_time(app, a.max_time);
  app.add_option("--replicates", a.replicates, "simulations per candidate, instead of the budget's")->check(CLI::NonNegativeNumber);
  app.add_flag(
      "--holdout", a.hold_out,
      "fit the first half of the recording alone, and score every model on the second, too; between them the time in which the group "
      "crosses itself is left out");
  app.add_flag(
      "--posterior", a.posterior,
      "beside the best parameters, their posterior distribution: 95 % intervals, which parameters the recording determines at all, and "
      "a sample of it");
  app.add_option("--set", a.set, "parameter=value, not searched; model.parameter=value for one model")->take_all();
  app.add_option("--fix", a.fix, "parameters to keep at their default")->delimiter(',')->take_all();
  app.add_option("--bounds", a.bounds, "parameter=lower:upper, searched in between")->take_all();
  add_conditions(app, a);
  app.add_option(
         "--error-limit", a.error_limit,
         "of a metric with a larger share of localisation error, differences that as much error again would make do not count in full "
         "(default 0.5)")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--resolution", a.resolution,
                 "recording (default): differences between models below what the recording can tell do not count in full; none: they do, "
                 "as published")
      ->check(CLI::IsMember({"recording", "none"}));
  app.add_option("--calibration", a.calibration,
                 "later passes search under the mean of all passes' weights (default), or under the last weights, as published")
      ->check(CLI::IsMember({"mean", "last"}));
  app.add_option("--scoring", a.scoring,
                 "how several simulations of a model are compared with the recording: by the energy score (proper, default), or as one "
                 "pooled distribution, as published (pooled)")
      ->check(CLI::IsMember({"proper", "pooled"}));
  app.add_option("--lags", a.lags,
                 "measure motion over this many frames, each lag as metrics of its own: 1,4,16; or auto (default), which adds to 1 the "
                 "shortest lag at which no metric of motion is past the error limit");
  app.add_option("--smooth", a.smoothing, "smooth recording and simulations alike, Gaussian, standard deviation in frames")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--velocity", a.velocity, "difference of positions, or the recorded velocity column")
      ->check(CLI::IsMember({"difference", "recorded"}))
      ->capture_default_str();
  app.add_option("--normalisation", a.normalisation,
                 "whose mean and deviation standardise the metrics: reference (default), separate or none")
      ->check(CLI::IsMember({"reference", "separate", "none"}));
  app.add_option("--bins", a.bins, "histogram bins, instead of the normalisation's default")->check(CLI::NonNegativeNumber);
}

void add_preset(CLI::App& app, FitArguments& a) {
  app.add_option("--preset", a.preset,
                 "noise: bswarm with its four noises; ablation: bswarm, without noise, without interaction; models: bswarm, noise_aware, "
                 "boids, rvo, brownian and the null model langevin; all: these and every other model")
      ->check(CLI::IsMember({"noise", "ablation", "models", "all"}));
}

int resume_run(const ResumeArguments&);

// All commands and what the user gave them.
struct Program {
  CLI::App app{"swarmfit - which model explains my tracks, with which parameters, and how sure can I be?"};
  FitArguments compare, fit;
  DescribeArguments describe;
  ConvertArguments convert;
  EvaluateArguments evaluate;
  WeighArguments weigh;
  SimulateArguments simulate;
  RecoverArguments recover;
  MergeArguments merge;
  PowerArguments power;
  ResumeArguments resume;
  ReportArguments report;
  ModelsArguments models;
  GalleryArguments gallery;
  Common list;
  std::function<int()> chosen;

  Program() {
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("swarmfit ") + kVersion);
    app.set_config("--config", "", "read options from a TOML file, such as config.toml of a run");
    app.allow_config_extras(CLI::config_extras_mode::error);
    app.fallthrough();
    app.failure_message([](const CLI::App*, const CLI::Error& e) { return std::string("swarmfit: ") + e.what() + "; see --help\n"; });
    add_describe();
    add_convert();
    add_simulate();
    add_evaluate();
    add_weigh();
    add_fits();
    add_resume();
    add_report();
    add_recover();
    add_merge();
    add_power();
    add_lists();
  }

  CLI::App& command(const char* name, const char* help, const std::function<int()>& run) {
    auto* sub = app.add_subcommand(name, help);
    sub->callback([this, run] { chosen = run; });
    return *sub;
  }

  void add_describe() {
    auto& sub = command("describe", "what is in a recording and what is wrong with it", [this] { return cli::describe(describe); });
    add_common(sub, describe.common);
    add_data(sub, describe.data, "DATA", "recording: a file, - for standard input, or demo");
    sub.add_option("--html", describe.html, "page to write, too: facts, warnings, the motion itself, distributions");
  }

  void add_convert() {
    auto& sub = command("convert", "write a recording as CSV, cleaned and with its units", [this] { return cli::convert(convert); });
    add_common(sub, convert.common);
    add_data(sub, convert.data, "DATA", "recording: a file, - for standard input, or demo");
    sub.add_option("-o,--out", convert.out, "file to write; - for standard output")->required();
    sub.add_option("--smooth", convert.smoothing, "Gaussian smoothing, standard deviation in frames")->check(CLI::NonNegativeNumber);
  }

  void add_simulate() {
    auto& a = simulate;
    auto& sub = command("simulate", "trajectories from a model", [this] { return cli::simulate(simulate); });
    add_common(sub, a.common);
    sub.add_option("MODEL", a.model, "model with settings: bswarm, 'bswarm[noise=white]'; see swarmfit models")->required();
    sub.add_option("-o,--out", a.out, "CSV file to write; - for standard output");
    sub.add_option("--picture", a.picture, "SVG file to write: the last frame, with the paths to it as fading tails");
    sub.add_option("--html", a.html, "page to write: the motion itself, parameters, distributions");
    sub.add_option("--set", a.set, "parameter=value, in simulation units")->take_all();
    sub.add_option("--agents", a.agents, "number of agents")->check(CLI::Range(1, 10000000))->capture_default_str();
    sub.add_option("--frames", a.frames, "frames to write")->check(CLI::PositiveNumber)->capture_default_str();
    sub.add_option("--warm-up", a.warm_up, "frames to simulate before the first one written")->check(CLI::NonNegativeNumber);
    sub.add_option("--fps", a.fps, "frames per second")->check(CLI::PositiveNumber)->capture_default_str();
    sub.add_option("--dims", a.dims, "2 or 3")->check(CLI::IsMember({2, 3}))->capture_default_str();
    sub.add_option("--box", a.box, "side of the reflecting box about the origin; 0 for open space")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    sub.add_option("--start-radius", a.start_radius, "agents start inside this radius; a quarter of the box if not given")
        ->check(CLI::NonNegativeNumber);
    sub.add_option("--start-speed", a.start_speed, "speed at the start")->check(CLI::NonNegativeNumber)->capture_default_str();
    sub.add_option("--obs-noise", a.noise, "localisation error to add to positions")->check(CLI::NonNegativeNumber);
    sub.add_option("--dropout", a.dropout, "probability per agent and frame that it is lost for up to five frames")
        ->check(CLI::Range(0.0, 1.0));
    sub.add_option("--unit", a.unit, "name of the length unit")->capture_default_str();
  }

  void add_evaluate() {
    auto& a = evaluate;
    auto& sub =
        command("evaluate", "seven energies and the order parameters of two recordings", [this] { return cli::evaluate(evaluate); });
    add_common(sub, a.common);
    add_data(sub, a.real, "REAL", "the recording");
    sub.add_option("SIM", a.simulated, "what is compared with it; read with the same options")->required();
    sub.add_option("--sim-columns", a.simulated_columns, "columns of SIM, where they differ");
    sub.add_option("--normalisation", a.normalisation, "reference, separate or none")
        ->check(CLI::IsMember({"reference", "separate", "none"}))
        ->capture_default_str();
    sub.add_option("--velocity", a.velocity, "difference or recorded")
        ->check(CLI::IsMember({"difference", "recorded"}))
        ->capture_default_str();
    sub.add_option("--lags", a.lags, "measure motion over this many frames, as in compare: 1,4,16 or auto")->capture_default_str();
    sub.add_option("--bins", a.bins, "histogram bins, instead of the normalisation's default")->check(CLI::NonNegativeNumber);
    sub.add_option("--html", a.html, "page to write, too: both in motion side by side, energies, distributions");
  }

  void add_weigh() {
    auto& sub = command("weigh", "entropy weights and scores of an energy table", [this] { return cli::weigh(weigh); });
    add_common(sub, weigh.common);
    sub.add_option("TABLE", weigh.table, "CSV: a header of metric names, then one row per model, its name first")->required();
  }

  void add_fits() {
    auto& one = command("fit", "best parameters of one model", [this] { return cli::fit(fit); });
    add_fit(one, fit);
    auto& many = command("compare", "fit several models and rank them", [this] { return cli::compare(compare); });
    add_fit(many, compare);
    add_preset(many, compare);
    many.add_flag("--common", compare.common_dynamics,
                  "fit what all the models have in common once, with the first of them, and keep it (the paper's noise comparison)");
  }

  void add_resume() {
    auto& sub = command("resume", "go on with an interrupted fit, compare, recover or power; same final bits",
                        [this] { return resume_run(resume); });
    sub.add_option("RUN_DIR", resume.dir, "its run directory, started from the folder in which the run was started")->required();
    sub.add_option("--threads", resume.threads, "threads to use, 0 for all cores; never changes a result")->check(CLI::NonNegativeNumber);
    add_max_time(sub, resume.max_time);
    add_part(sub, resume.part);
    sub.add_flag("--json", resume.json, "print JSON instead of text");
    sub.add_flag("-q,--quiet", resume.quiet, "no progress, no remarks");
  }

  static void add_part(CLI::App& sub, std::string& part) {
    sub.add_option("--part", part, "k/n: only every n-th recording of the study, from the k-th on; merge puts all n parts together")
        ->configurable(false);
  }

  void add_merge() {
    auto& sub = command("merge", "one study of the parts that recover or power made with --part", [this] {
      if (cluster().first()) merge_parts(merge);
      merge.resume.dir = merge.out;
      return resume_run(merge.resume);
    });
    sub.add_option("DIR", merge.dirs, "folders of all parts")->required();
    sub.add_option("-o,--out", merge.out, "run directory of the whole")->required();
    sub.add_option("--threads", merge.resume.threads, "threads to use, 0 for all cores; never changes a result")->check(CLI::NonNegativeNumber);
    sub.add_flag("--json", merge.resume.json, "print JSON instead of text");
    sub.add_flag("-q,--quiet", merge.resume.quiet, "no progress, no remarks");
  }

  void add_report() {
    auto& sub =
        command("report", "figures, tables and methods of a run, in the formats of a paper", [this] { return cli::report(report); });
    sub.add_option("RUN_DIR", report.dir, "folder of a run that has finished")->required();
    sub.add_option("--format", report.formats,
                   "svg or pdf: the figures; tex or md: tables, methods and captions; csv: tables in full; html: the report; several with "
                   "commas between. pdf takes rsvg-convert (package librsvg2-bin)")
        ->delimiter(',')
        ->take_all()
        ->check(CLI::IsMember({"svg", "pdf", "tex", "md", "csv", "html"}))
        ->required();
    sub.add_option("-o,--out", report.out, "folder to write to, where files of the same names are replaced; RUN_DIR-paper if not given");
    sub.add_flag("-q,--quiet", report.quiet, "do not list what was written");
  }

  void add_recover() {
    auto& a = recover;
    auto& sub = command("recover", "recordings made by each model, compared with all: which model wins on whose?",
                        [this] { return cli::recover(recover); });
    add_common(sub, a.common);
    sub.add_option("-m,--model", a.models, "models that are compared, comma-separated, with settings in brackets");
    sub.add_option("--preset", a.preset, "noise, ablation, models or all, as in compare")
        ->check(CLI::IsMember({"noise", "ablation", "models", "all"}));
    sub.add_flag("--parameters", a.parameters,
                 "of one model: do the 95 % intervals of its parameters hold the true values? These are drawn from the whole range that is "
                 "searched");
    sub.add_option("--plant", a.planted, "models that make recordings; all that are compared if not given");
    sub.add_option("--set", a.set, "model.parameter=value, of the planted models, in physical units")->take_all();
    sub.add_option("--seeds", a.seeds, "recordings per model")->check(CLI::PositiveNumber)->capture_default_str();
    add_part(sub, a.part);
    sub.add_option("--agents", a.agents, "individuals in a recording")->check(CLI::Range(2, 100000))->capture_default_str();
    sub.add_option("--frames", a.frames, "frames of a recording")->check(CLI::PositiveNumber)->capture_default_str();
    sub.add_option("--fps", a.fps, "frames per second")->check(CLI::PositiveNumber)->capture_default_str();
    sub.add_option("--dims", a.dims, "2 or 3")->check(CLI::IsMember({2, 3}))->capture_default_str();
    sub.add_option("--film-noise", a.noise, "localisation error of the planted recordings [unit]")->check(CLI::NonNegativeNumber);
    sub.add_option("--dropout", a.dropout, "probability per individual and frame that it is lost for up to five frames")
        ->check(CLI::Range(0.0, 1.0));
    sub.add_option("--spread", a.spread,
                   "planted parameters are the defaults times or by up to this factor, anew for every recording; 1: the defaults")
        ->check(CLI::Range(1.0, 100.0))
        ->capture_default_str();
    sub.add_option("--extent", a.extent, "rms radius of the planted groups [unit]")->check(CLI::PositiveNumber)->capture_default_str();
    sub.add_option("--spacing", a.spacing, "their nearest-neighbour distance [unit]")->check(CLI::PositiveNumber)->capture_default_str();
    sub.add_option("--speed", a.speed, "their mean speed [unit/s]")->check(CLI::PositiveNumber)->capture_default_str();
    sub.add_option("--unit", a.unit, "name of the length unit")->capture_default_str();
    sub.add_option("--obs-noise", a.observation_error, "as in compare");
    sub.add_option("--lags", a.lags, "as in compare; auto chooses for every recording");
    sub.add_option("--resolution", a.resolution, "as in compare")->check(CLI::IsMember({"recording", "none"}));
    sub.add_option("--scoring", a.scoring, "as in compare")->check(CLI::IsMember({"proper", "pooled"}));
    sub.add_option("--calibration", a.calibration, "as in compare")->check(CLI::IsMember({"mean", "last"}));
    sub.add_option("--steps", a.steps, "as in compare; recordings are filmed with ten steps per frame");
    sub.add_option("--protocol", a.protocol, "as in compare")->check(CLI::IsMember({"default", "ren2016"}))->capture_default_str();
    sub.add_option("--budget", a.budget, "how long to search: quick, default or thorough")->capture_default_str();
    sub.add_option("--max-evaluations", a.max_evaluations, "hard limit of candidates per model")->check(CLI::NonNegativeNumber);
    add_max_time(sub, a.max_time);
    sub.add_option("-o,--out", a.out, "run directory, with report.html to look at; swarmfit-recovery if not given");
  }

  void add_power() {
    power.fit.budget = "quick";
    auto& sub = command("power", "before any ranking: which models could this recording tell apart, and how much more would it take?",
                        [this] { return cli::power(power); });
    add_fit(sub, power.fit);
    add_preset(sub, power.fit);
    sub.add_option("--seeds", power.seeds, "recordings made by each model, 2 or more")->check(CLI::Range(2, 10000))->capture_default_str();
    add_part(sub, power.part);
  }

  void add_lists() {
    auto& all_models = command("models", "the models, their settings and parameters", [this] { return cli::list_models(models); });
    add_common(all_models, models.common);
    all_models.add_option("NAME", models.name, "one model only, with its manual page");
    all_models.add_flag("--page", models.page, "its page of docs/models, as Markdown");
    all_models.add_flag("--scene", models.scene, "flags of simulate for a scene that shows what it is known for");
    auto& all_in_motion = command("gallery", "a page with every model in motion", [this] { return cli::gallery(gallery); });
    add_common(all_in_motion, gallery.common);
    all_in_motion.add_option("FILE", gallery.out, "page to write, such as gallery.html")->required();
    auto& all_formats = command("formats", "the file formats that can be read", [this] { return cli::list_formats(list); });
    add_common(all_formats, list);
  }
};

// The run's own command, read from its config.toml.
int resume_run(const ResumeArguments& a) {
  const std::string config = a.dir + "/config.toml", command = command_of_run(a.dir);
  Program program;
  try {
    program.app.parse(std::vector<std::string>{a.dir, "--out", config, "--config", command});  // CLI11 takes them last first
  } catch (const CLI::ParseError& e) {
    throw InputError(config + ": " + e.what());
  }
  const auto go_on = [&](auto& run) {
    run.resume = true;
    run.max_time = a.max_time;
    run.common.threads = a.threads;
    run.common.json = a.json;
    run.common.quiet = a.quiet;
    return program.chosen();
  };
  if (command == "recover") {
    program.recover.part = a.part;
    return go_on(program.recover);
  }
  if (command == "power") {
    program.power.part = a.part;
    return go_on(program.power.fit);
  }
  if (!a.part.empty()) throw InputError(fmt::format("--part: {} is a run of swarmfit {}; expected recover or power", a.dir, command));
  return go_on(command == "fit" ? program.fit : program.compare);
}

// What other processes have no part in, the first does alone.
bool shares_work(const CLI::App& app) {
  const auto given = app.get_subcommands();
  constexpr std::array kShared = {"fit", "compare", "recover", "power", "resume", "merge"};
  return !given.empty() && std::find(kShared.begin(), kShared.end(), given.front()->get_name()) != kShared.end();
}

// The command as it was given, fit to be pasted into a shell.
std::string command_line(int argc, char** argv) {
  std::string line = "swarmfit";
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    const bool plain = word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+.,:/%@") == word.npos;
    line += ' ';
    if (plain && !word.empty()) {
      line += word;
      continue;
    }
    line += '\'';
    for (const char c : word) line += c == '\'' ? std::string("'\\''") : std::string(1, c);
    line += '\'';
  }
  return line;
}

int run(int argc, char** argv) {
  Program program;
  program.describe.line = program.simulate.line = program.evaluate.line = command_line(argc, argv);
  try {
    program.app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const int code = program.app.exit(e);
    return code == 0 ? 0 : 2;
  }
  install_interrupt_handler();
  return shares_work(program.app) || cluster().first() ? program.chosen() : 0;
}

// One line on standard error for whatever went wrong.
int complain(const char* what, int code) {
  std::fprintf(stderr, "swarmfit: %s\n", what);
  return cluster().leave(code, what);
}

}  // namespace
}  // namespace swarmfit::cli

int main(int argc, char** argv) {
  using swarmfit::cli::complain;
  swarmfit::keep_freed_memory();
  swarmfit::cli::cluster();
  try {
    return swarmfit::cli::cluster().leave(swarmfit::cli::run(argc, argv), "");
  } catch (const swarmfit::InputError& e) {
    return complain(e.what(), 2);
  } catch (const std::exception& e) {
    return complain(e.what(), 1);
  } catch (...) {
    return complain("an unknown error", 1);
  }
}
