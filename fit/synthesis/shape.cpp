// SPDX-License-Identifier: MIT
#include "fit/synthesis/shape.h"

#include <fmt/format.h>

#include "fit/experiment/conditions.h"
#include "fit/synthesis/recorded_velocities.h"
#include "libswarm/curve_guide.h"
#include "libswarm/noise.h"
#include "libswarm/simulate.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kSteps = 20;    // between key points
constexpr double kReach = 0.25;  // of that

using Eigen::Array3d;

State near_key_points(const Tracks& reference, const Curve& curve, double reach, int agents, const Rng& rng) {
  const RecordedVelocities velocities(reference);
  State state;
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(agents); ++k) {
    const auto u = rng.uniform2(Stream::start, 0, k);
    const Array3d aside = random_direction(rng, Stream::start, 1, k, 0, reference.dims()) * reach * rng.uniform(Stream::start, 2, k);
    const auto point = static_cast<std::size_t>(u[0] * static_cast<double>(curve.points.size()));
    state.spawn(0, curve.points[point] + aside, velocities.at(u[1]));
  }
  return state;
}

// Leaves out the first frames.
class Late : public FrameSink {
 public:
  Late(std::int64_t skipped, FrameSink& out) : skipped_(skipped), out_(out) {}
  void frame(const Snapshot& now) override {
    if (now.frame >= skipped_) out_.frame({now.frame - skipped_, now.id, now.kind, now.pos, now.vel, now.own});
  }

 private:
  std::int64_t skipped_;
  FrameSink& out_;
};

Curve drawn_at(const Tracks& reference, const DrawnCurve& drawn, const Scales& scales) {
  if (drawn.in_units) return drawn.curve;
  const double factor = kSteps * scales.speed * reference.dt() / drawn.curve.spacing();
  return placed(drawn.curve, factor, Array3d::Zero(), reference.dims() == 3);
}

}  // namespace

Shape fly_along(const Tracks& reference, const ShapeOptions& options) {
  const ModelChoice& model = options.pilot.model;
  if (model.spec->find("w_user") < 0)
    throw InputError(fmt::format("`curve`: {} cannot be led along a curve; expected a model that can: fastswarm", model.spec->name));
  const Scales scales = natural_scales(reference);
  if (!(scales.speed > 0))
    throw InputError(reference.meta().from.path + ": nothing moves; expected tracks of at least two frames with motion");
  Shape shape;
  shape.curve = drawn_at(reference, options.drawn, scales);
  const double reach = kReach * shape.curve.spacing();
  Pilot pilot = options.pilot;
  for (const auto& [name, value] : {std::pair("w_oa", 0.5), {"w_cos", 0.0}, {"w_n", 1.0}, {"w_user", 1.0}})
    pilot.set.try_emplace(name, value);
  shape.parameters = pilot_parameters(pilot, scales);
  const auto rule =
      make_model(model, {.dims = reference.dims(), .scales = scales, .reference = &reference, .rng = {pilot.seed}, .step = reference.dt()});
  World world;
  world.dims = reference.dims();
  world.add(std::make_unique<CurveGuide>(shape.curve, reach));
  TrackCollector collector;
  Late camera(options.warm_up, collector);
  const Plan plan{.frame_dt = reference.dt(), .frames = options.warm_up + options.frames};
  Lane lane{shape.parameters,
            {pilot.seed},
            near_key_points(reference, shape.curve, reach, options.agents, {pilot.seed}),
            world,
            &camera,
            {},
            false};
  cpu_backend().run(*rule, plan, {&lane, 1});
  if (lane.blew_up) throw InputError(model.name + ": the simulation diverged; expected parameters that keep motion finite");
  TrackMeta meta;
  meta.dims = reference.dims();
  meta.dt = reference.dt();
  meta.unit = reference.meta().unit;
  meta.from.path = model.name;
  meta.from.format = "simulated";
  meta.from.synthetic = true;
  shape.tracks = collector.take(meta);
  shape.following = following(shape.tracks, shape.curve, reach);
  return shape;
}

}  // namespace swarmfit
