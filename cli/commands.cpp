// SPDX-License-Identifier: MIT
#include "cli/commands.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>

#include "cli/cluster.h"
#include "cli/most_threads.h"
#include "cli/parts.h"
#include "cli/program.h"
#include "cli/setting.h"
#include "libtrack/error.h"

namespace swarmfit::cli {
namespace {

const std::array<Command, 22> kCommands{{
    {"describe", kDescribe, "what a recording contains, and what is wrong with it", describe},
    {"convert", kConvert, "write a recording in another format, cleaned and with its units", convert},
    {"simulate", kSimulate, "trajectories from a scenario or a model", simulate},
    {"extend", kExtend, "continue tracks beyond their ends and bridge their gaps, with a model", extend},
    {"augment", kAugment, "add simulated agents to a recording", augment},
    {"evaluate", kEvaluate, "compare two recordings: energy of every metric, order parameters", evaluate},
    {"measure", kMeasure, "order parameters and states of a group over time", measure},
    {"weigh", kWeigh, "entropy weights and scores of an energy table", weigh},
    {"fit", kFit, "best parameters of one model", fit},
    {"compare", kCompare, "fit several models and rank them", compare},
    {"resume", kResume, "continue an interrupted fit, compare, recover, power or sweep; the result is the same to the last bit", resume},
    {"report", kReport, "figures, tables and methods of a run, in the formats of a paper", report},
    {"recover", kRecover, "simulate each model and fit all: how often is the true model recovered?", recover},
    {"power", kPower, "before any ranking: which models can this recording distinguish, and how much more data would it take?", power},
    {"sweep", kSweep, "a model over a range of parameters: phase diagrams, order-parameter curves, hysteresis", sweep},
    {"merge", kMerge, "join the parts that recover, power or sweep made with --part into one study", merge},
    {"models", kModels, "the models, their options and parameters", list_models},
    {"scenarios", kScenarios, "scenes to simulate: their names, or the file of one", list_scenarios},
    {"gallery", kGallery, "a page with every scenario in motion", gallery},
    {"formats", kFormats, "the file formats that can be read", list_formats},
    {"manual", kManual, "every command and setting, as a man page or as Markdown", manual},
    {"completion", kCompletion, "completion of commands and settings for a shell", completion},
}};

}  // namespace

std::span<const Command> commands() { return kCommands; }

int run(const Arguments& a) {
  const int threads = a.common.threads > 0 ? a.common.threads : cluster().threads();
  omp_set_num_threads(std::min(threads > 0 ? threads : omp_get_max_threads(), kMostThreads));
  const auto command = std::find_if(kCommands.begin(), kCommands.end(), [&](const Command& c) { return c.name == a.command; });
  // What other processes have no part in, the first does alone.
  return (command->bit & kShared) != 0 || cluster().first() ? command->run(a) : 0;
}

// The run's own command, read from its config.toml.
int resume(const Arguments& a) {
  const std::string config = a.dir + "/config.toml";
  auto run_of = parse({command_of_run(a.dir), "--config", config, "--out", a.dir});
  run_of->resume = true;
  run_of->max_time = a.max_time;
  run_of->part = a.part;
  if (a.part.of > 1 && run_of->command != "recover" && run_of->command != "power" && run_of->command != "sweep")
    throw InputError(fmt::format("`part`: {} is a run of swarmfit {}; expected recover, power or sweep", a.dir, run_of->command));
  run_of->common.threads = a.common.threads;
  run_of->common.json = a.common.json;
  run_of->common.quiet = a.common.quiet;
  run_of->common.verbose = a.common.verbose;
  return run(*run_of);
}

int merge(const Arguments& a) {
  if (cluster().first()) merge_parts(a.dirs, a.out);
  cluster().broadcast("");  // the others wait for it
  Arguments whole = a;
  whole.dir = a.out;
  return resume(whole);
}

}  // namespace swarmfit::cli
