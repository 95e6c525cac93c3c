// SPDX-License-Identifier: MIT
// A swarm that draws a curve.
#include <fmt/format.h>

#include "cli/parse.h"
#include "cli/scenes.h"
#include "fit/synthesis/shape.h"
#include "libtrack/error.h"

namespace swarmfit::cli {

Film along_curve(const SceneArguments& a, Scenario& scene) {
  if (scene.name != scene.model.name)
    throw InputError(fmt::format("`curve`: {} is a scenario; expected a model alone: {}", scene.name, scene.model.spec->name));
  if (a.fps || a.box || a.start_radius || a.start_speed || a.noise > 0 || a.dropout > 0)
    throw InputError(
        "`curve`: agents begin by the curve, move as in the recording and are seen as they are; expected no fps, box, start-radius, "
        "start-speed, obs-noise or dropout beside it");
  ShapeOptions options;
  options.pilot = {scene.model, parse_assignments(a.set), "open", scene.seed};
  options.drawn = read_curve(a.curve);
  options.agents = scene.agents();
  options.frames = scene.frames;
  options.warm_up = scene.warm_up;
  Shape shape = fly_along(scene.reference ? *scene.reference : Tracks(), options);
  scene.parameters = std::move(shape.parameters);
  scene.bounds = {};  // it flew in the open
  TrackMeta meta = shape.tracks.meta();
  meta.unit = scene.unit;
  meta.from.notes = {fmt::format("mean distance to the curve {:.4g} {}, {:.2f} of the spacing of its key points; coverage {:.3f}",
                                 shape.following.distance, meta.unit, shape.following.distance / shape.curve.spacing(),
                                 shape.following.coverage)};
  Film made;
  made.tracks = Tracks(shape.tracks.columns(), std::move(meta));
  return made;
}

}  // namespace swarmfit::cli
