// SPDX-License-Identifier: MIT
// A swarm that draws a curve.
#include <fmt/format.h>

#include "cli/parse.h"
#include "cli/recordings.h"
#include "cli/scenes.h"
#include "fit/synthesis/shape.h"

namespace swarmfit::cli {

Scene along_curve(const SceneArguments& a) {
  Scene scene{parse_model(a.model), {}, {}};
  ShapeOptions options;
  options.pilot = {scene.model, parse_assignments(a.set), "open", a.seed};
  options.drawn = read_curve(a.curve);
  options.agents = a.agents;
  options.frames = a.frames;
  options.warm_up = a.warm_up;
  Shape shape = fly_along(load({}, a.like, {}), options);
  scene.parameters = std::move(shape.parameters);
  TrackMeta meta = shape.tracks.meta();
  meta.from.notes = {fmt::format("mean distance to the curve {:.4g} {}, {:.2f} of the spacing of its key points; coverage {:.3f}",
                                 shape.following.distance, meta.unit, shape.following.distance / shape.curve.spacing(),
                                 shape.following.coverage)};
  scene.tracks = Tracks(shape.tracks.columns(), meta);
  return scene;
}

}  // namespace swarmfit::cli
