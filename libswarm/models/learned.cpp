// SPDX-License-Identifier: MIT
//
// learned – forces and noise regressed from the recording
// =======================================================
// What any model whose agents answer each other's places and velocities in pairs could do, beside the models that somebody thought of.
// D. B. Brückner, P. Ronceray, C. P. Broedersz, Inferring the dynamics of underdamped stochastic systems, Phys. Rev. Lett. 125: 058103,
// 2020 (doi:10.1103/PhysRevLett.125.058103); F. Lu, M. Zhong, S. Tang, M. Maggioni, Nonparametric inference of interaction laws in systems
// of agents from trajectory data, PNAS 116: 14424, 2019 (doi:10.1073/pnas.1822012116). The regression is ours: libswarm/force_regression.h.
//
//   dv = (F + eta) dt + noise · white dW
//   F  = - drag · D(|v|) v - confinement · (stiffness (x - c) + hardening |x - c|² (x - c)) + push
//        + interaction · sum over others of (pair(r) r̂ + alignment(r) (v_j - v_i))
//   deta = - eta / tau dt + noise · coloured sqrt(2 / tau) dW,   tau = memory · the memory that was found
//
// D is a polynomial of second degree, pair and alignment are straight between knots at quantiles of the distances of pairs. Groups of terms
// that the recording does not need are left out; beyond the speeds, distances and pairs that it shows nothing is extrapolated. The
// parameters multiply what the regression found, which is 1: they repair what it misses at the recording's frame rate.
//
// Agents enter with an eta drawn from the stationary distribution given their place and velocity, with the drag at their speed and the
// stiffness at their place.
//
// It is made of the recording: judge it on what it did not learn from (--holdout yes).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "libswarm/force_regression.h"
#include "libswarm/model.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"
#include "libtrack/error.h"
#include "libtrack/normals.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kDrag, kConfinement, kInteraction, kNoise, kMemory };

constexpr Index kColumns = 3;  // eta

struct Buffers : Workspace {
  GaussianNoise white, coloured;
};

class Learned : public Model {
 public:
  explicit Learned(const Setup& setup) : dims_(setup.dims) {
    const ForceFit fit = fit_forces(*setup.reference, force_basis(*setup.reference));
    law_ = fit.law;
    if (!law_.coefficients.allFinite())
      throw InputError(
          fmt::format("learned: {} accelerations of the recording have a position at each of the five frames before; too few for {} terms",
                      fit.rows, law_.basis.size()));
    if (kernel(ForceGroup::pair) || kernel(ForceGroup::alignment)) reach_ = law_.basis.knots.back();
  }

  Index columns() const override { return kColumns; }
  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Buffers>(); }

  void enter(State& state, Index first, const World& world, const StepContext& c) const override {
    if (law_.memory <= 0) return;
    const double a = 1 / (c.p[kMemory] * law_.memory);
    for (Index i = first; i < state.size(); ++i) {
      const Array3d x = world.bounds.separation(law_.basis.centre, state.pos.row(i).transpose()), v = state.vel.row(i).transpose();
      const double g = std::max(0.0, c.p[kDrag] * law_.drag(std::sqrt(v.square().sum())));
      const double k = std::max(0.0, c.p[kConfinement] * law_.confinement(std::sqrt(x.square().sum())));
      const Array3d normal = three_normals(c.rng, Stream::hidden, c.tick, state.id[static_cast<std::size_t>(i)]);
      for (int axis = 0; axis < dims_; ++axis) {
        const double sd = c.p[kNoise] * law_.coloured[axis], white = c.p[kNoise] * law_.white[axis];
        if (sd <= 0) continue;
        // Stationary moments: <v eta> = s a, <x eta> = s, <vv> = (s a + w) / g, <xx> = (s (a + g) + w) / (g k) with half the white
        // variance, w.
        const double s = sd * sd / (k + a * g + a * a), w = 0.5 * white * white;
        const double on_v = g * s * a / (s * a + w), on_x = g * k * s / (s * (a + g) + w);
        const double rest = std::max(0.0, sd * sd - on_v * s * a - on_x * s);
        state.own(i, axis) = on_v * v[axis] + on_x * x[axis] + std::sqrt(rest) * normal[axis];
      }
    }
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    Buffers& buffers = *static_cast<Buffers*>(c.work);
    buffers.white.draw(c.rng, Stream::noise, c.tick, now.id);
    buffers.coloured.draw(c.rng, Stream::noise_path, c.tick, now.id);
    if (reach_ > 0) c.near.build(now.pos, world.bounds, reach_);
    const double kept = law_.memory > 0 ? std::exp(-c.dt / (c.p[kMemory] * law_.memory)) : 0;
    const Array3d fresh = c.p[kNoise] * std::sqrt(1 - kept * kept) * law_.coloured;
    const Array3d kick = c.p[kNoise] * std::sqrt(c.dt) * law_.white;
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      const Array3d v = now.vel.row(i).transpose(), eta = now.own.row(i).transpose();
      const Array3d after = v + c.dt * (force(now, i, world, c) + eta) + flat(kick * buffers.white[i]);
      next.vel.row(i) = after.transpose();
      next.pos.row(i) = now.pos.row(i) + (0.5 * c.dt) * (v + after).transpose();
      next.own.row(i) = (kept * eta + flat(fresh * buffers.coloured[i])).transpose();
    });
    return next.vel.isFinite().all() ? Step::done : Step::blew_up;
  }

 private:
  bool kernel(ForceGroup group) const {
    const auto first = static_cast<Index>(law_.basis.first(group)), count = static_cast<Index>(law_.basis.count(group));
    return count > 0 && (law_.coefficients.segment(first, count).array() != 0).any();
  }

  Array3d flat(const Array3d& a) const { return dims_ == 2 ? Array3d(a[0], a[1], 0) : a; }

  Array3d force(const State& now, Index i, const World& world, const StepContext& c) const {
    const Array3d v = now.vel.row(i).transpose();
    const Array3d x = world.bounds.separation(law_.basis.centre, now.pos.row(i).transpose());
    const double distance = std::min(std::sqrt(x.square().sum()), law_.basis.reach);
    Array3d out = -c.p[kDrag] * law_.drag(std::sqrt(v.square().sum())) * v;
    for (int axis = 0; axis < dims_; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      const double stiffness = law_.at(ForceGroup::confinement, k) + distance * distance * law_.at(ForceGroup::hardening);
      out[axis] += c.p[kConfinement] * stiffness * x[axis] + law_.at(ForceGroup::push, k);
    }
    if (reach_ <= 0 || c.p[kInteraction] == 0) return out;
    Array3d pairs = Array3d::Zero();
    c.near.visit(i, [&](Index j, const Array3d& offset, double r) {
      if (r <= 0) return;
      const ForceBasis::Hat hat = law_.basis.hat(r);
      const auto at = [&](ForceGroup group) {
        return hat.weight * law_.at(group, hat.first) + (hat.next > 0 ? hat.next * law_.at(group, hat.first + 1) : 0);
      };
      pairs += at(ForceGroup::pair) / r * offset + at(ForceGroup::alignment) * (now.vel.row(j).transpose() - v);
    });
    return out + c.p[kInteraction] * pairs;
  }

  int dims_;
  ForceLaw law_;
  double reach_ = 0;  // of the kernels; 0: there are none
};

const std::vector<Parameter>& parameter_table() {
  constexpr const char* ours = "1: as regressed";
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kDrag, .name = "drag", .symbol = "drag", .scene = {1, 0, 10}, .fit = {1, 0, 4}, .fitted = true,
       .meaning = "drag, in multiples of what the regression found", .source = ours},
      {.row = kConfinement, .name = "confinement", .symbol = "confinement", .scene = {1, 0, 10}, .fit = {1, 0, 4}, .fitted = true,
       .meaning = "confinement, in multiples of what the regression found", .source = ours},
      {.row = kInteraction, .name = "interaction", .symbol = "interaction", .scene = {1, 0, 10}, .fit = {1, 0, 4}, .fitted = true,
       .meaning = "forces of pairs, in multiples of what the regression found", .source = ours},
      {.row = kNoise, .name = "noise", .symbol = "noise", .scene = {1, 0, 10}, .fit = {1, 0, 4}, .fitted = true,
       .meaning = "noise, in multiples of what the regression found", .source = ours},
      {.row = kMemory, .name = "memory", .symbol = "memory", .scene = {1, 0.01, 100}, .fit = {1, 0.2, 5}, .log = true, .fitted = true,
       .meaning = "time for which the noise is remembered, in multiples of what the regression found", .source = ours},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec learned_spec() {
  return {.name = "learned",
          .summary = "challenger: drag, confinement, forces of pairs and noise regressed from the recording",
          .citation = "Brückner et al. 2020, doi:10.1103/PhysRevLett.125.058103; Lu et al. 2019, doi:10.1073/pnas.1822012116",
          .dims = {2, 3},
          .needs_reference = true,
          .native_dt = 0.01,
          .largest_dt = 0.1,
          .quiet = "noise=0",
          .options = {},
          .columns = {"eta_x", "eta_y", "eta_z"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Learned>(setup); }};
}

}  // namespace swarmfit
