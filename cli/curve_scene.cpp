// SPDX-License-Identifier: MIT
// A swarm that draws a curve: Xiang et al. 2020 (doi:10.1002/cav.1957), section 5.1.2.
#include <fmt/format.h>

#include "cli/scenes.h"
#include "libeval/following.h"
#include "libtrack/error.h"
#include "libtrack/read/read_curve.h"

namespace swarmfit::cli {
namespace {

constexpr double kSteps = 20;  // of the recording between key points, if the curve has no lengths

}  // namespace

void lead_along(Scenario& scene, const SceneArguments& a) {
  if (scene.name != scene.model.name)
    throw InputError(fmt::format("`curve`: {} is a scenario; expected a model alone: {}", scene.name, scene.model.spec->name));
  if (a.fps || a.box || a.start_radius || a.start_speed)
    throw InputError(
        "`curve`: agents start on the curve, as fast as in the recording; expected none of fps, box, start-radius, start-speed with it");
  if (scene.model.spec->find("w_user") < 0)
    throw InputError(fmt::format("`curve`: {} cannot be led along a curve; expected a model that can: fastswarm", scene.model.spec->name));
  if (!(scene.scales.speed > 0))
    throw InputError(scene.reference->meta().from.path + ": nothing moves; expected tracks of at least two frames with motion");
  const DrawnCurve drawn = read_curve(a.curve);
  const double factor = drawn.in_units ? 1 : kSteps * scene.scales.speed * scene.dt / drawn.curve.spacing();
  CurveToFollow way{drawn.in_units ? drawn.curve : placed(drawn.curve, factor, Eigen::Array3d::Zero(), scene.dims == 3), 0};
  way.reach = usual_reach(way.curve);
  Start& start = scene.groups.front().start;
  start.shape = Start::Shape::curve;
  start.points = way.curve.points;
  start.radius = way.reach;
  scene.curve = std::move(way);
  for (const auto& [name, value] : {std::pair("w_oa", 0.5), {"w_cos", 0.0}, {"w_n", 1.0}, {"w_user", 1.0}})
    scene.parameters[static_cast<std::size_t>(scene.model.spec->find(name))] = value;
}

std::string drawn_text(const Scenario& scene, const Tracks& agents) {
  const Following found = following(agents, agents.frames(), scene.curve->curve, scene.curve->reach);
  return fmt::format("mean distance to the curve {:.4g} {}, {:.2f} of the distance of its key points; coverage {:.3f}", found.distance,
                     scene.unit, found.distance / scene.curve->curve.spacing(), found.coverage);
}

}  // namespace swarmfit::cli
