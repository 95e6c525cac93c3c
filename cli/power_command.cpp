// SPDX-License-Identifier: MIT
// power: fit every model, let it make recordings like this one, and see which of them are told apart.
#include <fmt/format.h>

#include <cstdio>

#include "cli/checkpoints.h"
#include "cli/cluster.h"
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/parts.h"
#include "cli/presets.h"
#include "cli/progress.h"
#include "cli/recordings.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/study/power.h"
#include "libtrack/error.h"
#include "reports/study/power_report.h"

namespace swarmfit::cli {

int power(const Arguments& a) {
  PowerOptions options{a.compare, a.seeds};
  if (a.by_preset) without_learners(options.compare.models);  // others are planted, and it would learn from each anew
  if (a.recordings.size() != 1) throw InputError("power: expected one recording");
  if (options.compare.models.size() < 2)
    throw InputError(fmt::format("power: fewer than two models; expected -m A,B,... or --preset {}", preset_list()));
  const std::string dir = a.out.empty() ? "swarmfit-power" : a.out;
  if (cluster().first()) check_run_directory(dir);
  if (a.max_time > 0) stop_after(a.max_time);
  const Settings& settings = a.config;
  const Tracks recording = load(a, a.recordings.front());
  Checkpoint checkpoint = checkpoint_in(dir, {kVersion, recording.meta().from.sha256, config_toml("power", settings)}, a.resume);
  checkpoint.on_add(something_was_kept);
  Power result;
  try {
    StudyProgress progress(a.common.quiet, 1 + options.compare.models.size() * static_cast<std::size_t>(a.seeds));
    const auto on_power = [&](std::size_t done, std::size_t) {
      if (done > 0) progress.done(done == 1 ? "models fitted to the recording" : "a simulated recording compared");
    };
    const auto on_progress = [&](const CompareProgress& now) { progress.show(now); };
    result = swarmfit::power(recording, options, on_power, {on_progress, {&executor(), &checkpoint}, a.part});
  } catch (const Interrupted&) {
    return stopped_before_the_end(dir);
  }
  result.fitted.run.version = kVersion;
  if (!cluster().first()) return 0;
  if (a.part.of > 1) return part_done(dir, a.part, a.common.quiet);
  write_power(dir, result, settings);
  remove_checkpoint(dir);
  std::fputs(a.common.json ? to_json(result, settings).c_str() : power_text(result, style()).c_str(), stdout);
  return 0;
}

}  // namespace swarmfit::cli
