// SPDX-License-Identifier: MIT
// measure: order parameters, curves and states of a recording.
#include <cstdio>

#include "cli/commands.h"
#include "cli/recordings.h"
#include "cli/style.h"
#include "cli/version.h"
#include "fit/compare/force_view.h"
#include "libeval/group/measured.h"
#include "reports/study/measure_report.h"
#include "reports/write/run_folder.h"

namespace swarmfit::cli {

int measure(const Arguments& a) {
  const std::string dir = a.out.empty() ? "swarmfit-measure" : a.out;
  check_run_directory(dir);
  const Tracks tracks = load(a, a.recordings.front());
  Measured measured = swarmfit::measure(tracks, a.measure);
  for (GroupCurve& curve : force_curves(tracks)) measured.groups.front().curves.curves.push_back(std::move(curve));
  write_measured(dir, tracks.meta(), measured, a.config, kVersion);
  std::fputs(a.common.json ? to_json(tracks.meta(), measured, a.config).c_str() : measure_text(tracks.meta(), measured, style()).c_str(),
             stdout);
  return 0;
}

}  // namespace swarmfit::cli
