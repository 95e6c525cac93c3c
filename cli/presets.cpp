// SPDX-License-Identifier: MIT
#include "cli/presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/parse.h"

namespace swarmfit::cli {
namespace {

struct Preset {
  const char *name, *meaning;
  std::vector<std::string> models;
  std::vector<std::string> published = {};  // what Ren et al. 2016 compared to the letter, where that differs
};

const std::vector<Preset>& presets() {
  static const std::vector<Preset> table = {
      {"noise",
       "bswarm with its four noises and two controls, a force with a memory but no field and a field for each agent",
       {"bswarm", "bswarm[noise=perlin]", "bswarm[noise=gaussian]", "bswarm[noise=white]", "bswarm[noise=ou]", "bswarm[offset=per_agent]"},
       {"bswarm", "bswarm[noise=perlin]", "bswarm[noise=gaussian,noise_scaling=literal]", "bswarm[noise=white,noise_scaling=literal]"}},
      {"ablation", "bswarm, without noise, without interaction", {"bswarm", "bswarm[noise=none]", "bswarm[interaction=off]"}},
      {"models",
       "bswarm, noise_aware, boids, rvo, brownian, the null model langevin and the challenger learned",
       {"bswarm", "noise_aware", "boids", "rvo", "brownian", "langevin", "learned"},
       {"bswarm", "noise_aware", "boids", "rvo", "brownian"}},
      {"flocks",
       "models of birds and fish: bswarm, boids, vicsek, zonal, local_attraction without and with repulsion, pigeon, langevin and learned",
       {"bswarm", "boids", "vicsek", "zonal", "local_attraction", "local_attraction[repulsion=on]", "pigeon", "langevin", "learned"}},
  };
  return table;
}

constexpr const char* kEveryModel = "all";

// What any of them names, and all other models that move in two and in three dimensions; fastswarm, which copies the recording, is asked
// for by name.
std::vector<std::string> all_models() {
  std::vector<std::string> all;
  const auto add = [&](const std::string& name) {
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  };
  for (const Preset& preset : presets())
    for (const auto& name : preset.models) add(name);
  for (const auto& spec : models())
    if (spec.dims.size() > 1 && !spec.needs_reference) add(spec.name);
  return all;
}

}  // namespace

std::vector<std::string_view> preset_names() {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) names.emplace_back(preset.name);
  names.emplace_back(kEveryModel);
  return names;
}

std::string_view preset_help() {
  static const std::string help = [] {
    std::string text;
    for (const Preset& preset : presets()) text += fmt::format("{}: {}; ", preset.name, preset.meaning);
    return text + "all: these, and every other model that moves in two and in three dimensions";
  }();
  return help;
}

std::string preset_list() { return fmt::format("{}", fmt::join(preset_names(), "|")); }

std::vector<ModelChoice> preset_models(const std::string& preset, bool as_published) {
  for (const Preset& known : presets())
    if (preset == known.name) return parse_models(as_published && !known.published.empty() ? known.published : known.models);
  return parse_models(all_models());
}

void without_learners(std::vector<ModelChoice>& models) {
  std::erase_if(models, [](const ModelChoice& m) { return m.spec->needs_reference; });
}

}  // namespace swarmfit::cli
