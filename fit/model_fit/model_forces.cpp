// SPDX-License-Identifier: MIT
#include "fit/model_fit/model_forces.h"

#include <algorithm>
#include <utility>

#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr double kMoment = 1e-5;  // frames: a step so short that only the force is seen

}  // namespace

ModelForces::ModelForces(const ModelChoice& model, const Conditions& conditions, const SymmetricDifferences& seen)
    : rows_(static_cast<Index>(seen.rows().size())) {
  const Tracks& recording = conditions.recording;
  world_.dims = recording.dims();
  world_.bounds = conditions.world.bounds;
  plan_.frame_dt = kMoment * recording.dt();
  plan_.first_frame = 1;  // in frame 0 a large group would be put in order
  plan_.frames = 2;
  model_ = make_model(model, {.dims = recording.dims(),
                              .scales = conditions.scales,
                              .reference = conditions.reference ? conditions.reference.get() : &recording,
                              .step = plan_.frame_dt,
                              .kinds = recording.kinds()});
  std::vector<Index> equation(static_cast<std::size_t>(recording.rows()), -1);
  for (Index u = 0; u < rows_; ++u) equation[static_cast<std::size_t>(seen.rows()[static_cast<std::size_t>(u)])] = u;
  for (const FrameRange& frame : recording.frames()) add(frame, seen, equation);
}

void ModelForces::add(const FrameRange& frame, const SymmetricDifferences& seen, const std::vector<Index>& equation) {
  Moment moment;
  moment.equation.assign(equation.begin() + frame.first, equation.begin() + frame.first + frame.count);
  if (std::all_of(moment.equation.begin(), moment.equation.end(), [](Index u) { return u < 0; })) return;
  moment.state.append(frame.count);
  for (Index i = 0; i < frame.count; ++i) {
    const Index row = frame.first + i;
    moment.state.pos.row(i) = seen.x(row).transpose();
    moment.state.vel.row(i) = seen.v(row).transpose();
    moment.state.kind[static_cast<std::size_t>(i)] = seen.tracks().kind(row);
  }
  moments_.push_back(std::move(moment));
}

std::array<Eigen::VectorXd, 3> ModelForces::at(const std::vector<double>& parameters) const {
  std::array<Eigen::VectorXd, 3> out;
  for (auto& axis : out) axis = Eigen::VectorXd::Zero(rows_);
  for (const Moment& moment : moments_) {
    Lane lane{.p = parameters, .rng = {}, .state = moment.state, .world = world_, .out = nullptr, .count = {}};
    cpu_backend().run(*model_, plan_, {&lane, 1});
    for (std::size_t i = 0; i < moment.equation.size(); ++i) {
      if (moment.equation[i] < 0) continue;
      const auto row = static_cast<Index>(i);
      for (Index axis = 0; axis < 3; ++axis)
        out[static_cast<std::size_t>(axis)][moment.equation[i]] =
            lane.blew_up ? kNaN : (lane.state.vel(row, axis) - moment.state.vel(row, axis)) / plan_.frame_dt;
    }
  }
  return out;
}

}  // namespace swarmfit
