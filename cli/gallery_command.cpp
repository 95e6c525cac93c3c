// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/scenes.h"
#include "cli/version.h"
#include "libtrack/file.h"
#include "reports/recording/gallery_html.h"

namespace swarmfit::cli {
namespace {

constexpr std::int64_t kFrames = 240;  // some seconds, and a page that stays small

}  // namespace

int gallery(const Arguments& a) {
  std::vector<Exhibit> exhibits;
  for (const ModelSpec& spec : models()) {
    const std::string name(spec.name);
    SceneArguments scene = scene_of(name);
    scene.seed = a.common.seed;
    scene.frames = kFrames;
    const Scene made = simulated(scene);
    exhibits.push_back(
        {card_of(made), fmt::format("swarmfit simulate {0} {1} --html {0}.html", name, scene_flags(name, kFrames)), made.tracks});
  }
  write_file_atomically(a.out, gallery_html(exhibits, kVersion));
  return 0;
}

}  // namespace swarmfit::cli
