// SPDX-License-Identifier: MIT
//
// zonal – repulsion, orientation and attraction in nested zones, with a bounded rate of turning
// ==============================================================================================
// I. D. Couzin, J. Krause, R. James, G. D. Ruxton, N. R. Franks, Collective memory and spatial sorting in animal groups, J. Theor. Biol.
// 218, 1-11, 2002 (doi:10.1006/jtbi.2002.3065), in the form of D. Strömbom, thesis, Uppsala University, 2013, section 1.2.1.
//
//   Every tau seconds each agent looks at the others, at distance d, offset r and with heading u, and takes a desired direction D:
//     anybody at d <= R_r          D = - sum of r / d over them
//     else                         O = sum of u over R_r < d <= R_o,   A = sum of r / d over R_o < d <= R_a
//                                  D = (O + A) / 2, or the one of them whose zone is not empty
//     nobody, or D = 0             D = own heading
//   D is then turned by a random angle, normal with standard deviation sigma; in three dimensions about a random axis at right angles.
//   The heading turns towards D by at most turning tau at once, and the agent flies straight on at constant speed until the next decision:
//     u turned towards D by at most turning tau;  x = x + speed tau u
//
// Zones are stored as the widths of their shells: R_r = r_rep, R_o = r_rep + r_ori, R_a = r_rep + r_ori + r_att. Sums are not averaged: of
// orientation and attraction the zone with more agents weighs more. Behind its back an agent is blind to orientation and attraction
// within the angle `blind` (2002: 90°; thesis: none).
//
// That is a map, with step length delta = speed tau and largest turn theta_m = turning tau: half the tau is another model, and simulating
// in finer steps changes nothing, since decisions and their random numbers belong to multiples of tau. A step longer than tau holds one
// decision only, so in fits a tau below the recording's frame interval is that interval.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "libswarm/decision_clock.h"
#include "libswarm/headings.h"
#include "libswarm/noise.h"
#include "libswarm/own_heading.h"
#include "libswarm/parallel.h"
#include "libswarm/zones.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kSpeed, kTurning, kSigma, kRRep, kROri, kRAtt, kBlind, kTau };

class Zonal : public Model {
 public:
  explicit Zonal(const Setup& setup) : dims_(setup.dims), frame_(setup.reference ? setup.reference->dt() : 0) {}

  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<OwnHeadings>(); }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    const double interval = std::max(c.p[kTau], frame_);
    const auto decision = decision_due(c, interval);
    // Neighbours are those strictly nearer than the radius given, the outermost zone holds its edge.
    auto& headings = *static_cast<OwnHeadings*>(c.work);
    headings.take(now, c.rng, dims_);
    if (decision) c.near.build(now.pos, world.bounds, (c.p[kRRep] + c.p[kROri] + c.p[kRAtt]) * (1 + 1e-12));
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      Array3d heading = headings.of.row(i).transpose();
      if (decision) {
        const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
        const Array3d goal = noisy(desired(headings.of, i, id, c), id, *decision, c);
        heading = turned_towards(heading, goal, c.p[kTurning] * interval, aside(heading, id, c));
      }
      next.vel.row(i) = c.p[kSpeed] * heading.transpose();
      next.pos.row(i) = now.pos.row(i) + c.dt * next.vel.row(i);
    });
    return Step::done;
  }

 private:
  Array3d desired(const Rows& headings, Index i, std::uint32_t id, const StepContext& c) const {
    const Array3d heading = headings.row(i).transpose();
    const double r_rep = c.p[kRRep], r_ori = r_rep + c.p[kROri], r_att = r_ori + c.p[kRAtt];
    const double seen_from = -std::cos(c.p[kBlind] / 2);  // least cosine of the angle to the heading
    Array3d repulsion = Array3d::Zero(), orientation = Array3d::Zero(), attraction = Array3d::Zero();
    int repelling = 0, orienting = 0, attracting = 0;
    c.near.visit(i, [&](Index j, const Array3d& offset, double d) {
      if (d <= r_rep) {
        const auto draw = static_cast<std::uint32_t>(++repelling);
        // Agents at one place have no direction from one to the other: one is drawn.
        repulsion -= d < kCoincident ? random_direction(c.rng, Stream::tie_break, c.tick, id, draw, dims_) : Array3d(offset / d);
        return;
      }
      if (repelling > 0 || d > r_att || d < kCoincident || (offset * heading).sum() < seen_from * d) return;
      if (d <= r_ori) {
        orientation += headings.row(j).transpose();
        ++orienting;
      } else {
        attraction += offset / d;
        ++attracting;
      }
    });
    Array3d sum = repulsion;
    if (repelling == 0) sum = orienting > 0 && attracting > 0 ? Array3d((orientation + attraction) / 2) : Array3d(orientation + attraction);
    const Array3d direction = heading_of(sum);
    return (direction == 0).all() ? heading : direction;
  }

  Array3d noisy(const Array3d& direction, std::uint32_t id, std::uint64_t decision, const StepContext& c) const {
    if (c.p[kSigma] == 0) return direction;
    const double angle = c.p[kSigma] * c.rng.normal2(Stream::noise, decision, id, 0)[0];
    const double round = 2 * std::numbers::pi * c.rng.uniform(Stream::noise, decision, id, 1);
    return turned(direction, perpendicular(direction, round, dims_), angle);
  }

  // Where to turn when the desired direction is straight behind: one drawn for good, to the left or right in two dimensions.
  Array3d aside(const Array3d& heading, std::uint32_t id, const StepContext& c) const {
    const double u = c.rng.uniform(Stream::tie_break, 1, id);
    const Array3d side = perpendicular(heading, 2 * std::numbers::pi * u, dims_);
    return dims_ == 2 && u < 0.5 ? Array3d(-side) : side;
  }

  int dims_;
  double frame_;  // frame interval of the recording, or 0
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr double pi = std::numbers::pi, degree = pi / 180;
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kSpeed, .name = "speed", .symbol = "s", .unit = {1, -1}, .scene = {3, 0.01, 100}, .fit = {1, 0.1, 4}, .log = true,
       .fitted = true, .meaning = "constant speed", .source = "2002, Table 1", .shown = Parameter::Shown::speed},
      {.row = kTurning, .name = "turning", .symbol = "θ", .unit = {0, -1}, .scene = {40 * degree, 0.01, 100}, .fit = {5, 0.2, 60},
       .log = true, .fitted = true, .meaning = "highest rate of turning [rad/s]", .source = "2002, Table 1: 10-100 degrees per second"},
      {.row = kSigma, .name = "sigma", .symbol = "σ", .unit = {0, 0}, .scene = {0.05, 0.001, pi}, .fit = {0.2, 0.01, pi}, .log = true,
       .fitted = true, .meaning = "error of a decision [rad]", .source = "2002, Table 1: 0-11.5 degrees"},
      {.row = kRRep, .name = "r_rep", .symbol = "R_r", .unit = {1, 0}, .scene = {1, 0, 20}, .fit = {0.5, 0, 3}, .length = spacing,
       .fitted = true, .meaning = "radius of repulsion", .source = "2002, Table 1"},
      {.row = kROri, .name = "r_ori", .symbol = "ΔR_o", .unit = {1, 0}, .scene = {2, 0, 50}, .fit = {1, 0, 10}, .length = spacing,
       .fitted = true, .meaning = "width of the shell of orientation", .source = "2002, Table 1"},
      {.row = kRAtt, .name = "r_att", .symbol = "ΔR_a", .unit = {1, 0}, .scene = {14, 0, 50}, .fit = {5, 0, 10}, .length = spacing,
       .fitted = true, .meaning = "width of the shell of attraction", .source = "2002, Table 1"},
      {.row = kBlind, .name = "blind", .unit = {0, 0}, .scene = {0, 0, 2 * pi}, .fit = {0, 0, 2 * pi},
       .meaning = "angle behind the back without orientation and attraction [rad]", .source = "thesis: none; 2002: 90 degrees"},
      {.row = kTau, .name = "tau", .symbol = "τ", .unit = {0, 1}, .scene = {0.1, 1e-4, 10}, .fit = {0.05, 0.01, 1}, .log = true,
       .fitted = true, .meaning = "time between decisions; at least the recording's frame interval", .source = "2002, Table 1"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec zonal_spec() {
  return {.name = "zonal",
          .summary = "repulsion, orientation and attraction in nested zones, with a bounded rate of turning",
          .citation = "Couzin et al. 2002, doi:10.1006/jtbi.2002.3065; in the form of Strömbom 2013, thesis, Uppsala",
          .dims = {2, 3},
          .native_dt = 0.1,
          .map = "always",
          .quiet = "sigma=0",
          .options = {},
          .columns = {},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Zonal>(setup); }};
}

}  // namespace swarmfit
