// SPDX-License-Identifier: MIT
// fit and compare: the same job with one model or several.
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/checkpoints.h"
#include "cli/cluster.h"
#include "cli/commands.h"
#include "cli/config_file.h"
#include "cli/interrupt.h"
#include "cli/presets.h"
#include "cli/progress.h"
#include "cli/recordings.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/compare/across.h"
#include "fit/compare/facts.h"
#include "libeval/lags.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "reports/comparison/across_report.h"
#include "reports/comparison/json.h"
#include "reports/comparison/ranking_text.h"
#include "reports/comparison/words.h"
#include "reports/run/run_directory.h"
#include "reports/write/run_folder.h"

namespace swarmfit::cli {
namespace {

std::string name_of(const std::string& path) {
  const auto stem = std::filesystem::path(path).stem().string();
  return stem.empty() || stem == "-" ? "stdin" : stem;
}

// What may differ between two runs of the same job stands here and nowhere else.
void write_timing(const std::string& dir, double seconds, const Tally& tally) {
  const nlohmann::ordered_json timing = {{"wall_seconds", seconds},
                                         {"processes", cluster().size()},
                                         {"threads", omp_get_max_threads()},
                                         {"simulations", tally.made},
                                         {"simulations_taken_up", tally.found},
                                         {"simulations_per_second", static_cast<double>(tally.made) / seconds},
                                         {"batches", tally.batches},
                                         {"largest_batch", tally.largest_batch}};
  write_file_atomically(dir + "/timing.json", timing.dump(2) + '\n');
}

// After an interruption: nothing that was kept is simulated again.
void say_what_was_taken_up(const Arguments& a, const Tally& tally) {
  if (a.resume && !a.common.quiet)
    std::fprintf(stderr, "%lld simulations from before the interruption, %lld new ones\n", static_cast<long long>(tally.found),
                 static_cast<long long>(tally.made));
}

// Compares on one recording and writes its run directory. The checkpoint stays: the caller removes it when all is done.
Comparison run_one(const Arguments& a, const CompareOptions& options, const Tracks& recording, const std::string& path,
                   const std::string& dir) {
  const auto start = std::chrono::steady_clock::now();
  const Settings config = with(a.config, "DATA", toml_array({path}));
  const auto text = config_toml(options.models.size() > 1 ? "compare" : "fit", config);
  // Of several recordings, one whose turn had not come has no checkpoint to take up.
  Checkpoint checkpoint = checkpoint_in(dir, {kVersion, recording.meta().from.sha256, text}, a.resume);
  checkpoint.on_add(something_was_kept);
  ProgressLine line(a.common.quiet);
  const OnCompareProgress on_progress = [&line](const CompareProgress& now) { line.show(now); };
  Tally tally;
  const Runtime runtime{&executor(), &checkpoint, &tally};
  Comparison result = swarmfit::compare(recording, options, on_progress, runtime);
  result.run.version = kVersion;
  result.run.config = config;
  if (!cluster().first()) return result;
  write_run(dir, result);
  write_timing(dir, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), tally);
  say_what_was_taken_up(a, tally);
  return result;
}

Detail detail(const Arguments& a) { return a.common.verbose ? Detail::all : Detail::few; }

void say_where(const Arguments& a, const std::string& dir) {
  if (!a.common.quiet) std::fprintf(stderr, "report: %s\n", (std::filesystem::path(dir) / "report.html").c_str());
}

// Every recording gets a folder of its own, named after its file; equal names are numbered.
int run_several(const Arguments& a, const CompareOptions& options, const std::string& dir) {
  check_requests(options.requests, options.models);
  std::vector<Tracks> recordings;
  std::vector<std::string> names;
  for (const auto& path : a.recordings) {
    recordings.push_back(load(a, path));
    lags_for(make_conditions(recordings.back(), options.conditions), options);  // refuses what cannot be fitted
    const auto same = std::count_if(a.recordings.begin(), a.recordings.begin() + static_cast<std::ptrdiff_t>(names.size()),
                                    [&](const std::string& other) { return name_of(other) == name_of(path); });
    names.push_back(name_of(path) + (same > 0 ? "-" + std::to_string(same + 1) : ""));
  }
  if (!a.resume && cluster().first()) begin_run(dir, config_toml("compare", a.config));
  std::vector<Comparison> results;
  std::vector<RecordingPage> pages;
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    results.push_back(run_one(a, options, recordings[k], a.recordings[k], dir + '/' + names[k]));
    if (!a.common.json) std::printf("%s\n", ranking_text(results.back(), style(), detail(a)).c_str());
    pages.push_back({names[k], headline(results.back()).sentence});
    results.back().run.history.clear();  // written, and long; films likewise
    results.back().film = {};
    for (auto& model : results.back().models) model.film = {};
  }
  const Across summary = across(results);
  if (cluster().first()) write_across(dir, summary, pages, kVersion);
  for (const auto& name : names) remove_checkpoint(fmt::format("{}/{}", dir, name));
  std::fputs(a.common.json ? to_json(summary).c_str() : across_text(summary, style()).c_str(), stdout);
  say_where(a, dir);
  return 0;
}

int run_fit(const Arguments& a) {
  const CompareOptions& options = a.compare;
  if (a.max_time > 0) stop_after(a.max_time);
  const std::string dir = !a.out.empty() ? a.out : "swarmfit-" + (a.recordings.size() > 1 ? "several" : name_of(a.recordings.front()));
  if (cluster().first()) check_run_directory(dir);
  try {
    if (a.recordings.size() > 1) return run_several(a, options, dir);
    const Comparison result = run_one(a, options, load(a, a.recordings.front()), a.recordings.front(), dir);
    remove_checkpoint(dir);
    std::fputs(a.common.json ? to_json(result).c_str() : ranking_text(result, style(), detail(a)).c_str(), stdout);
    say_where(a, dir);
    return 0;
  } catch (const Interrupted&) {
    return stopped_before_the_end(dir);
  }
}

}  // namespace

std::string command_of_run(const std::string& dir) {
  std::string command = unfinished_run(dir);
  constexpr std::array kGoOn = {"fit", "compare", "recover", "power", "sweep"};
  if (std::find(kGoOn.begin(), kGoOn.end(), command) == kGoOn.end())
    throw InputError(fmt::format("{}: a run of swarmfit {}; expected one of fit, compare, recover, power or sweep", dir, command));
  return command;
}

int compare(const Arguments& a) {
  if (a.compare.models.size() < 2)
    throw InputError(
        fmt::format("compare: fewer than two models; expected -m A,B,... or --preset {} (or swarmfit fit for one model)", preset_list()));
  return run_fit(a);
}

int fit(const Arguments& a) {
  if (a.recordings.size() != 1) throw InputError("fit: expected one recording; swarmfit compare takes several");
  if (a.compare.models.size() != 1) throw InputError("fit: expected exactly one model, as in -m bswarm; swarmfit compare takes several");
  return run_fit(a);
}

}  // namespace swarmfit::cli
