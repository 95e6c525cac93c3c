// SPDX-License-Identifier: MIT
// describe, convert, simulate, and the lists.
#include <fmt/format.h>

#include <cstdio>

#include "cli/commands.h"
#include "cli/model_page.h"
#include "cli/settings.h"
#include "cli/style.h"
#include "fit/plant.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/kinematics.h"
#include "libtrack/read.h"
#include "libtrack/write.h"
#include "reports/json.h"
#include "reports/picture.h"
#include "reports/terminal.h"

namespace swarmfit::cli {
namespace {

void print(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

void write_tracks(const std::string& path, const Tracks& tracks) {
  if (path == "-")
    print(to_csv(tracks));
  else
    write_file_atomically(path, to_csv(tracks));
}

Bounds box(double side, int dims) {
  Bounds bounds;
  if (side <= 0) return bounds;
  bounds.kind = Bounds::Kind::box;
  bounds.lower.head(dims).setConstant(-0.5 * side);
  bounds.upper.head(dims).setConstant(0.5 * side);
  return bounds;
}

int list(const char* what, const std::vector<ListEntry>& entries, const Common& common) {
  print(common.json ? to_json(what, entries) : list_text(entries, style()));
  return 0;
}

}  // namespace

int describe(const DescribeArguments& a) {
  use_threads(a.common);
  const Tracks tracks = load(a.data);
  const Summary summary = summarise(tracks);
  print(a.common.json ? to_json(tracks.meta(), summary) : describe_text(tracks.meta(), summary, style()));
  return 0;
}

int convert(const ConvertArguments& a) {
  use_threads(a.common);
  Tracks tracks = load(a.data);
  if (a.smoothing > 0) tracks = smooth(tracks, a.smoothing);
  write_tracks(a.out, tracks);
  return 0;
}

int simulate(const SimulateArguments& a) {
  if (a.out.empty() && a.picture.empty()) throw InputError("simulate: nothing to write; expected --out FILE or --picture FILE");
  use_threads(a.common);
  const ModelChoice model = parse_model(a.model);
  PlantOptions o;
  o.dims = a.dims;
  o.agents = a.agents;
  o.frames = a.frames;
  o.dt = 1 / a.fps;
  o.substeps = std::max(1, static_cast<int>(std::ceil(o.dt / model.spec->native_dt - 1e-9)));
  o.warm_up = a.warm_up;
  o.arena = box(a.box, a.dims);
  o.start_radius = a.start_radius > 0 ? a.start_radius : a.box > 0 ? a.box / 4 : 1;
  o.start_speed = a.start_speed;
  o.sigma = a.noise;
  o.dropout = a.dropout;
  o.seed = a.common.seed;
  o.unit = a.unit;
  o.path = model.name;
  const Tracks tracks = plant(model, scene_parameters(model, parse_assignments(a.set)), o);
  if (!a.out.empty()) write_tracks(a.out, tracks);
  if (!a.picture.empty()) write_file_atomically(a.picture, picture_svg(tracks, model.name));
  return 0;
}

int list_models(const ModelsArguments& a) {
  if (a.name.empty()) {
    if (a.page) throw InputError("models --page: of which model? expected a name before it; see swarmfit models");
    std::vector<ListEntry> entries;
    for (const auto& spec : models()) entries.push_back(model_entry(spec));
    return list("models", entries, a.common);
  }
  const ModelSpec& spec = *parse_model(a.name).spec;
  if (a.page)
    print(model_page(spec));
  else if (a.common.json)
    print(to_json("models", {model_entry(spec)}));
  else
    print(model_manual(spec) + '\n' + list_text({model_entry(spec)}, style()));
  return 0;
}

int list_formats(const Common& common) {
  std::vector<ListEntry> entries;
  for (const auto& format : formats())
    entries.push_back({std::string(format.name), std::string(format.summary), {{"endings", std::string(format.endings)}}});
  return list("formats", entries, common);
}

}  // namespace swarmfit::cli
