// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/scenes.h"
#include "cli/version.h"
#include "fit/experiment/scenery.h"
#include "libtrack/file.h"
#include "reports/recording/gallery_html.h"

namespace swarmfit::cli {
namespace {

// A page that stays small: some seconds, and of a crowd some.
constexpr std::int64_t kFrames = 200;
constexpr std::uint32_t kAgents = 100;
constexpr int kMostSimulated = 500;

std::int64_t stride_of(const Tracks& tracks) {
  return std::max<std::int64_t>(1, (static_cast<std::int64_t>(tracks.frames().size()) + kFrames - 1) / kFrames);
}

// The first agents only, at every n-th frame.
Tracks thinned(const Tracks& tracks, std::int64_t stride) {
  TrackColumns some;
  const auto& all = tracks.columns();
  std::vector<Index> rows;
  for (Index row = 0; row < tracks.rows(); ++row) {
    const auto r = static_cast<std::size_t>(row);
    if (all.track[r] >= kAgents || all.frame[r] % stride != 0) continue;
    rows.push_back(row);
    some.track.push_back(all.track[r]);
    some.frame.push_back(all.frame[r] / stride);
    if (!all.kind.empty()) some.kind.push_back(all.kind[r]);
  }
  some.names.assign(all.names.begin(), all.names.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(all.names.size(), kAgents)));
  some.pos = all.pos(rows, Eigen::all);
  TrackMeta meta = tracks.meta();
  meta.dt *= static_cast<double>(stride);
  return Tracks(std::move(some), std::move(meta));
}

}  // namespace

int gallery(const Arguments& a) {
  std::vector<Exhibit> exhibits;
  for (const ScenarioFile& file : scenario_files()) {
    Scenario scene = scenario_named(file.name);
    learn_from(scene, "demo");
    if (a.scene.seed) scene.seed = *a.scene.seed;
    scene.groups.front().agents = std::min(scene.groups.front().agents, kMostSimulated);
    Film made = film(scene, {});
    const std::int64_t stride = stride_of(made.tracks);
    made.tracks = thinned(made.tracks, stride);
    if (made.stimuli.rows() > 0) made.stimuli = thinned(made.stimuli, stride);
    exhibits.push_back(
        {card_of(scene), fmt::format("swarmfit simulate {0} --html {0}.html", scene.name), made.tracks, scenery_of(scene, made)});
  }
  write_file_atomically(a.out, gallery_html(exhibits, kVersion));
  return 0;
}

}  // namespace swarmfit::cli
