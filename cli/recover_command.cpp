// SPDX-License-Identifier: MIT
// recover: plant models, film them, compare, and count who wins on whose recording.
#include <fmt/format.h>

#include <cstdio>

#include "cli/checkpoints.h"
#include "cli/cluster.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/parts.h"
#include "cli/presets.h"
#include "cli/progress.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/study/parameter_recovery.h"
#include "fit/study/recovery.h"
#include "libtrack/error.h"
#include "reports/study/parameter_recovery_report.h"
#include "reports/study/recovery_report.h"

namespace swarmfit::cli {
namespace {

constexpr double kLongestCrossing = 1e6;  // frames

RecoveryOptions recovery_options(const Arguments& a) {
  RecoveryOptions o = a.recovery;
  o.compare = a.compare;
  if (a.by_preset) without_learners(o.compare.models);  // there is no recording to learn from
  if (a.parameters && o.compare.models.size() != 1) throw InputError("recover `parameters`: expected exactly one model, as in -m brownian");
  if (!a.parameters && o.compare.models.size() < 2)
    throw InputError(fmt::format("recover: fewer than two models; expected -m A,B,... or --preset {}", preset_list()));
  // Before it is filmed a group crosses itself, simulated frame by frame.
  if (const double crossing = o.scales.time() / o.film.dt; crossing > kLongestCrossing)
    throw InputError(
        fmt::format("recover: at this `fps` a group takes {:.3g} frames to move by its `extent` at its `speed`; expected at most {:g}",
                    crossing, kLongestCrossing));
  return o;
}

int recover_models_of(const Arguments& a, const RecoveryOptions& options, const std::string& dir, Checkpoint& checkpoint) {
  const auto total = options.planted.size() * static_cast<std::size_t>(options.seeds);
  StudyProgress progress(a.common.quiet, total);
  const auto on_case = [&](const RecoveryCase& c) {
    progress.done(fmt::format("{}, seed {}: {} first", options.planted[c.planted].name, c.seed, c.order.front()));
  };
  const auto on_progress = [&](const CompareProgress& now) { progress.show(now); };
  const Recovery result = recover_models(options, on_case, {on_progress, {&executor(), &checkpoint}, a.part});
  if (!cluster().first() || a.part.of > 1) return 0;
  write_recovery(dir, result, a.config, kVersion);
  std::fputs(a.common.json ? to_json(result, a.config).c_str() : recovery_text(result, style()).c_str(), stdout);
  return 0;
}

int recover_parameters_of(const Arguments& a, const RecoveryOptions& options, const std::string& dir, Checkpoint& checkpoint) {
  const auto on_case = [&](std::size_t done) {
    if (!a.common.quiet) std::fprintf(stderr, "%zu/%d\n", done, options.seeds);
  };
  const ParameterRecovery result = recover_parameters(options, on_case, {&executor(), &checkpoint}, a.part);
  if (!cluster().first() || a.part.of > 1) return 0;
  write_parameter_recovery(dir, result, a.config, kVersion);
  std::fputs(a.common.json ? to_json(result, a.config).c_str() : parameter_recovery_text(result, style()).c_str(), stdout);
  return 0;
}

}  // namespace

int recover(const Arguments& a) {
  const RecoveryOptions options = recovery_options(a);
  const std::string dir = a.out.empty() ? "swarmfit-recovery" : a.out;
  if (cluster().first()) check_run_directory(dir);
  if (a.max_time > 0) stop_after(a.max_time);
  Checkpoint checkpoint = checkpoint_in(dir, {kVersion, "", config_toml("recover", a.config)}, a.resume);
  checkpoint.on_add(something_was_kept);
  try {
    const int code = a.parameters ? recover_parameters_of(a, options, dir, checkpoint) : recover_models_of(a, options, dir, checkpoint);
    if (a.part.of > 1) return cluster().first() ? part_done(dir, a.part, a.common.quiet) : 0;
    remove_checkpoint(dir);
    return code;
  } catch (const Interrupted&) {
    return stopped_before_the_end(dir);
  }
}

}  // namespace swarmfit::cli
