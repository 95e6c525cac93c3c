// SPDX-License-Identifier: MIT
// fit and compare: the same job with one model or several.
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/settings.h"
#include "cli/style.h"
#include "cli/version.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "reports/json.h"
#include "reports/run_directory.h"
#include "reports/terminal.h"

namespace swarmfit::cli {
namespace {

std::string run_directory(const FitArguments& a) {
  if (!a.out.empty()) return a.out;
  const auto stem = std::filesystem::path(a.data.path).stem().string();
  return "swarmfit-" + (stem.empty() || stem == "-" ? std::string("stdin") : stem);
}

// What may differ between two runs of the same job stands here and nowhere else.
void write_timing(const std::string& dir, double seconds, const Comparison& result) {
  std::int64_t simulations = 0;
  for (const auto& model : result.models) simulations += model.simulations;
  write_file_atomically(
      dir + "/timing.json",
      fmt::format("{{\n  \"wall_seconds\": {:.3f},\n  \"threads\": {},\n  \"simulations\": {},\n  \"simulations_per_second\": {:.1f}\n}}\n",
                  seconds, omp_get_max_threads(), simulations, static_cast<double>(simulations) / seconds));
}

int run(const FitArguments& a, const CompareOptions& options) {
  use_threads(a.common);
  const std::string dir = run_directory(a);
  check_run_directory(dir);
  const Tracks recording = load(a.data);
  const auto start = std::chrono::steady_clock::now();
  Comparison result;
  try {
    ProgressLine line(a.common.quiet);
    result = swarmfit::compare(recording, options, [&line](const CompareProgress& now) {
      line.show(now);
      return !interrupted();
    });
  } catch (const Interrupted&) {
    std::fprintf(stderr, "swarmfit: interrupted; nothing was written\n");
    return kInterrupted;
  }
  result.version = kVersion;
  result.config = resolved(a, options.models);
  write_run(dir, result);
  write_timing(dir, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), result);
  std::fputs(a.common.json ? to_json(result).c_str() : ranking_text(result, style()).c_str(), stdout);
  if (!a.common.quiet) std::fprintf(stderr, "report: %s\n", (std::filesystem::path(dir) / "report.html").c_str());
  return 0;
}

}  // namespace

int compare(const FitArguments& a) {
  const CompareOptions options = compare_options(a);
  if (options.models.size() < 2)
    throw InputError(
        "compare: fewer than two models; expected -m A,B,... or --preset noise|ablation|models (or swarmfit fit for one model)");
  return run(a, options);
}

int fit(const FitArguments& a) {
  const CompareOptions options = compare_options(a);
  if (options.models.size() != 1) throw InputError("fit: expected exactly one model, as in -m bswarm; swarmfit compare takes several");
  return run(a, options);
}

}  // namespace swarmfit::cli
