// SPDX-License-Identifier: MIT
//
// vicsek – alignment with noise at constant speed
// ================================================
// T. Vicsek, A. Czirók, E. Ben-Jacob, I. Cohen, O. Shochet, Novel type of phase transition in a system of self-driven particles, Phys. Rev.
// Lett. 75, 1226, 1995 (doi:10.1103/PhysRevLett.75.1226). Vectorial noise after G. Grégoire, H. Chaté, Onset of collective and cohesive
// motion, Phys. Rev. Lett. 92, 025702, 2004 (doi:10.1103/PhysRevLett.92.025702).
//
// Every tau seconds each agent takes the mean direction of all within `radius`, itself included, with an error; at the same moments, all
// agents at once:
//
//   theta_i(t + tau) = arg(sum over |r_ij| < radius of e^(i theta_j(t))) + U[-eta/2, eta/2]        noise=scalar
//   v_i(t + tau)     = v0 unit(sum over |r_ij| < radius of v_j / |v_j| + eta_vectorial n_i xi)     noise=vectorial
//   x_i(t + tau)     = x_i(t) + v_i(t) tau
//
// n_i is the number of terms of the sum, xi a random unit vector. In three dimensions scalar noise turns the mean direction about a random
// axis at right angles to it. A sum of 0 keeps the agent's own direction. Agents that fly apart never meet again in open space: nothing
// but alignment holds them together.
//
// Noise is per decision, so tau is part of the model: half the tau with the same eta is another model. In scenes tau is 1, as published.
// In fits tau = 0 stands for the recording's frame interval: one decision per frame, straight flight in between. Simulating in finer steps
// changes nothing: decisions and their random numbers belong to multiples of tau. A step longer than tau holds one decision only.
//
// Options (first value: default)
//   noise    scalar | vectorial: an error of the agent's own steering, or of what it sees of each neighbour
//   update   old: positions move on with the old direction while the new one is found, as in 1995 | new: with the new one, as in most
//            later work
#include <cmath>
#include <numbers>

#include "libswarm/decision_clock.h"
#include "libswarm/headings.h"
#include "libswarm/noise.h"
#include "libswarm/own_heading.h"
#include "libswarm/parallel.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kSpeed, kRadius, kEta, kEtaVectorial, kTau };

// Private columns: with update=old the direction found at the last decision, to be taken at the next.
enum : Index { kFound };

class Vicsek : public Model {
 public:
  explicit Vicsek(const Setup& setup)
      : dims_(setup.dims),
        frame_(setup.reference ? setup.reference->dt() : 0),
        vectorial_(setup.options.at("noise") == "vectorial"),
        old_(setup.options.at("update") == "old") {}

  Index columns() const override { return 3; }
  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<OwnHeadings>(); }

  void enter(State& state, Index first, const World&, const StepContext& c) const override {
    for (Index i = first; i < state.size(); ++i) state.own.row(i).segment<3>(kFound) = own_heading(state, i, c.rng, dims_).transpose();
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    const double interval = c.p[kTau] > 0 ? c.p[kTau] : frame_;
    const auto decision = decision_due(c, interval);
    const bool taken = old_ && interval_ends(c, interval);
    auto& headings = *static_cast<OwnHeadings*>(c.work);
    headings.take(now, c.rng, dims_);
    if (decision) c.near.build(now.pos, world.bounds, c.p[kRadius]);
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      Array3d heading = headings.of.row(i).transpose();
      Array3d found = now.own.row(i).segment<3>(kFound).transpose();
      if (decision) found = decide(headings.of, i, now.id[static_cast<std::size_t>(i)], c, *decision);
      if (decision && !old_) heading = found;
      next.pos.row(i) = now.pos.row(i) + c.p[kSpeed] * c.dt * heading.transpose();
      next.vel.row(i) = c.p[kSpeed] * (taken ? found : heading).transpose();
      next.own.row(i).segment<3>(kFound) = found.transpose();
    });
    return Step::done;
  }

 private:
  Array3d decide(const Rows& headings, Index i, std::uint32_t id, const StepContext& c, std::uint64_t decision) const {
    const Array3d own = headings.row(i).transpose();
    Array3d sum = own;
    double terms = 1;
    c.near.visit(i, [&](Index j, const Array3d&, double) {
      sum += headings.row(j).transpose();
      terms += 1;
    });
    if (vectorial_) sum += c.p[kEtaVectorial] * terms * random_direction(c.rng, Stream::noise, decision, id, 0, dims_);
    Array3d mean = heading_of(sum);
    if ((mean == 0).all()) mean = own;
    if (vectorial_) return mean;
    const auto u = c.rng.uniform2(Stream::noise, decision, id);
    return turned(mean, perpendicular(mean, 2 * std::numbers::pi * u[1], dims_), c.p[kEta] * (u[0] - 0.5));
  }

  int dims_;
  double frame_;  // frame interval of the recording, or 0
  bool vectorial_, old_;
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr double circle = 2 * std::numbers::pi;
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kSpeed, .name = "speed", .symbol = "v0", .unit = {1, -1}, .scene = {0.03, 0.001, 10}, .fit = {1, 0.1, 4}, .log = true,
       .fitted = true, .meaning = "constant speed", .source = "1995, text", .shown = Parameter::Shown::speed},
      {.row = kRadius, .name = "radius", .symbol = "r", .unit = {1, 0}, .scene = {1, 0.01, 100}, .fit = {1.5, 0.1, 10}, .length = spacing,
       .log = true, .fitted = true, .meaning = "radius of perception", .source = "1995, text"},
      {.row = kEta, .name = "eta", .symbol = "η", .unit = {0, 0}, .scene = {1, 0, circle}, .fit = {0.5, 0.01, circle}, .log = true,
       .fitted = true, .when = "noise=scalar", .meaning = "width of the error of a decision [rad]", .source = "1995, eq 2"},
      {.row = kEtaVectorial, .name = "eta_vectorial", .symbol = "η", .unit = {0, 0}, .scene = {0.3, 0, 2}, .fit = {0.3, 0.01, 2},
       .log = true, .fitted = true, .when = "noise=vectorial",
       .meaning = "length of the error, relative to a neighbour's direction", .source = "2004, eq 2"},
      {.row = kTau, .name = "tau", .symbol = "Δt", .unit = {0, 1}, .scene = {1, 0, 100}, .fit = {0, 0, 1},
       .meaning = "time between decisions; 0: the recording's frame interval, or every step", .source = "1995, text; in fits our choice"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec vicsek_spec() {
  return {.name = "vicsek",
          .summary = "alignment with noise at constant speed",
          .citation =
              "Vicsek et al. 1995, doi:10.1103/PhysRevLett.75.1226; vectorial noise: Grégoire and Chaté 2004, "
              "doi:10.1103/PhysRevLett.92.025702",
          .dims = {2, 3},
          .native_dt = 1,
          .map = "always",
          .quiet = "eta=0,eta_vectorial=0",
          .options = {{"noise",
                       {"scalar", "vectorial"},
                       "error of the own steering, or of what is seen of each neighbour",
                       {"an error of the own steering", "an error in what is seen of each neighbour"}},
                      {"update",
                       {"old", "new"},
                       "positions move on with the old direction, or with the new one",
                       {"positions that move on with the old direction", "positions that move on with the new direction"}}},
          .columns = {"found_x", "found_y", "found_z"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Vicsek>(setup); }};
}

}  // namespace swarmfit
