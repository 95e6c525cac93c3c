// SPDX-License-Identifier: MIT
// power: fit every model, let it make recordings like this one, and see which of them are told apart.
#include <fmt/format.h>

#include <cstdio>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/settings.h"
#include "cli/style.h"
#include "cli/version.h"
#include "libtrack/error.h"
#include "reports/power_report.h"

namespace swarmfit::cli {

int power(const PowerArguments& given) {
  const FitArguments a = with_protocol(given.fit);
  use_threads(a.common);
  const PowerOptions options{compare_options(a), given.seeds};
  if (a.recordings.size() != 1) throw InputError("power: expected one recording");
  if (options.compare.models.size() < 2)
    throw InputError("power: fewer than two models; expected -m A,B,... or --preset noise|ablation|models|all");
  const std::string dir = a.out.empty() ? "swarmfit-power" : a.out;
  check_run_directory(dir);
  Power result;
  try {
    result = swarmfit::power(load(a.data, a.recordings.front()), options, [&](std::size_t done, std::size_t all) {
      if (!a.common.quiet && done > 0) std::fprintf(stderr, "comparison %zu of %zu done\n", done, all);
      return !interrupted();
    });
  } catch (const Interrupted&) {
    std::fprintf(stderr, "swarmfit: interrupted; nothing was written\n");
    return kInterrupted;
  }
  result.fitted.version = kVersion;
  Settings settings = resolved(a, options.compare.models);
  settings.emplace_back("seeds", std::to_string(given.seeds));
  write_power(dir, result, settings);
  std::fputs(a.common.json ? to_json(result, settings).c_str() : power_text(result, style()).c_str(), stdout);
  return 0;
}

}  // namespace swarmfit::cli
