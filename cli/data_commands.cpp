// SPDX-License-Identifier: MIT
// describe, convert, simulate, and the lists.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

#include "cli/commands.h"
#include "cli/settings.h"
#include "cli/style.h"
#include "fit/plant.h"
#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/kinematics.h"
#include "libtrack/read.h"
#include "libtrack/write.h"
#include "reports/json.h"
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

std::string row_text(const Parameter& p) {
  const auto unit = to_string(p.unit, "L");
  return fmt::format("{}{}; scenes {:g} in {:g} .. {:g}; fits {:g} in {:g} .. {:g} {}{}{}", p.meaning,
                     unit.empty() ? "" : " [" + unit + "]", p.scene.initial, p.scene.lower, p.scene.upper, p.fit.initial, p.fit.lower,
                     p.fit.upper, p.length == Parameter::Length::spacing ? "(in NND)" : "(in L, T)", p.fitted ? ", searched" : "",
                     p.when.empty() ? "" : fmt::format(", with {}", p.when));
}

ListEntry entry(const ModelSpec& spec) {
  ListEntry e{std::string(spec.name), std::string(spec.summary), {{"source", std::string(spec.citation)}}};
  for (const auto& option : spec.options)
    e.facts.emplace_back(fmt::format("[{}={}]", option.name, fmt::join(option.values, "|")), std::string(option.meaning));
  for (const auto& parameter : spec.parameters) e.facts.emplace_back(std::string(parameter.name), row_text(parameter));
  return e;
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
  write_tracks(a.out, plant(model, scene_parameters(model, parse_assignments(a.set)), o));
  return 0;
}

int list_models(const Common& common) {
  std::vector<ListEntry> entries;
  for (const auto& spec : models()) entries.push_back(entry(spec));
  return list("models", entries, common);
}

int list_formats(const Common& common) {
  std::vector<ListEntry> entries;
  for (const auto& format : formats())
    entries.push_back({std::string(format.name), std::string(format.summary), {{"endings", std::string(format.endings)}}});
  return list("formats", entries, common);
}

}  // namespace swarmfit::cli
