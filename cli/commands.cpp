// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <omp.h>

#include <algorithm>
#include <array>

#include "cli/program.h"
#include "cli/setting.h"
#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

const std::array<Command, 14> kCommands{{
    {"describe", kDescribe, "what is in a recording and what is wrong with it", describe},
    {"convert", kConvert, "write a recording as CSV, cleaned and with its units", convert},
    {"simulate", kSimulate, "trajectories from a model", simulate},
    {"evaluate", kEvaluate, "seven energies and the order parameters of two recordings", evaluate},
    {"weigh", kWeigh, "entropy weights and scores of an energy table", weigh},
    {"fit", kFit, "best parameters of one model", fit},
    {"compare", kCompare, "fit several models and rank them", compare},
    {"resume", kResume, "go on with an interrupted fit, compare, recover or power; same final bits", resume},
    {"report", kReport, "figures, tables and methods of a run, in the formats of a paper", report},
    {"recover", kRecover, "recordings made by each model, compared with all: which model wins on whose?", recover},
    {"power", kPower, "before any ranking: which models could this recording tell apart, and how much more would it take?", power},
    {"models", kModels, "the models, their settings and parameters", list_models},
    {"gallery", kGallery, "a page with every model in motion", gallery},
    {"formats", kFormats, "the file formats that can be read", list_formats},
}};

}  // namespace

std::span<const Command> commands() { return kCommands; }

int run(const Arguments& a) {
  if (a.common.threads > 0) omp_set_num_threads(a.common.threads);
  return std::find_if(kCommands.begin(), kCommands.end(), [&](const Command& c) { return c.name == a.command; })->run(a);
}

// The run's own command, read from its config.toml.
int resume(const Arguments& a) {
  const std::string config = a.dir + "/config.toml";
  auto run_of = parse({command_of_run(a.dir), "--config", config, "--out", a.dir});
  run_of->resume = true;
  run_of->max_time = a.max_time;
  run_of->common.threads = a.common.threads;
  run_of->common.json = a.common.json;
  run_of->common.quiet = a.common.quiet;
  return run(*run_of);
}

}  // namespace swarmfit::cli
