// SPDX-License-Identifier: MIT
//
// pigeon – every bird keeps a separation from the centre of its nearest neighbours
// =================================================================================
// G. Dieck Kattas, X.-K. Xu, M. Small, the "naive" model, Chaos, 2012 (arXiv:1204.6547); its curves describe what models fitted to flights
// of homing pigeons do (the same authors, PLoS Comput. Biol. 8: e1002449, 2012, doi:10.1371/journal.pcbi.1002449). The text that this was
// built from has its formulas masked: they are rebuilt from its words.
//
//   Every tau seconds, with X the mean position of the `neighbours` nearest others and s = |X - x|:
//     p = x + tau V(s) u                          straight on, u being the direction of the last displacement
//     z = X + mean displacement of these others   where they will be if they go on as they did
//     x = p + 1/2 (|z - p| - max(0, s + A(s))) unit(z - p) + noise
//   all at once: half of what is to change, as the others do the other half. V is the curve of speed, A the change of separation in tau,
//   negative where others attract. The noise is uniform within ±noise tau along every axis. There is no limit to speed. Without others a
//   bird flies straight on, with the speed of a large separation.
//
// Curves are natural cubic splines through knots, constant beyond the last:
//     A at s / s0 = 0, 0.5, 1, 3, 6, 10, 15, 20, 25     values a0 .. a8, times attraction tau
//     V at s / s0 = 0, 1, 3, 6, 10, 15, 25              values v0 .. v6, times speed
// The default shape is ours, with what is known of the published one: repulsion below 20 m, attraction up to 500 m, strongest near 120 m,
// high speed near 20 m and low speed far away. Fits scale both curves and leave their shapes alone, unless told otherwise by --bounds.
//
// That is a map: half the tau is another model. A displacement is velocity times tau, which is also how a bird begins: with its position
// and velocity two positions are known. In fits a tau below the recording's frame interval is that interval.
#include <array>
#include <boost/math/interpolators/cubic_hermite.hpp>
#include <cmath>
#include <memory>

#include "libswarm/decision_clock.h"
#include "libswarm/headings.h"
#include "libswarm/noise.h"
#include "libswarm/own_heading.h"
#include "libswarm/parallel.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

constexpr std::size_t kAttractionKnots = 9, kSpeedKnots = 7;
constexpr std::array<double, kAttractionKnots> kAttractionAt{0, 0.5, 1, 3, 6, 10, 15, 20, 25};
constexpr std::array<double, kSpeedKnots> kSpeedAt{0, 1, 3, 6, 10, 15, 25};

// Rows of the parameter table, in its order.
enum Row : std::size_t {
  kSpeed,
  kS0,
  kAttraction,
  kNeighbours,
  kNoise,
  kTau,
  kFirstA,
  kFirstV = kFirstA + kAttractionKnots,
  kRows = kFirstV + kSpeedKnots
};

// Natural cubic spline through (x, y), constant outside: its slopes by the tridiagonal system, its values by Boost.
class Curve {
 public:
  Curve(std::span<const double> x, std::span<const double> y) : first_(x.front()), last_(x.back()), ends_{y.front(), y.back()} {
    spline_ = std::make_unique<Spline>(std::vector(x.begin(), x.end()), std::vector(y.begin(), y.end()), slopes(x, y));
  }

  double operator()(double s) const { return s <= first_ ? ends_[0] : s >= last_ ? ends_[1] : (*spline_)(s); }

 private:
  using Spline = boost::math::interpolators::cubic_hermite<std::vector<double>>;

  // Second derivatives agree at inner knots and are 0 at the ends; solved by elimination (Thomas).
  static std::vector<double> slopes(std::span<const double> x, std::span<const double> y) {
    const std::size_t n = x.size();
    std::vector<double> diagonal(n), above(n), right(n);
    const auto width = [&](std::size_t k) { return x[k + 1] - x[k]; };
    const auto secant = [&](std::size_t k) { return (y[k + 1] - y[k]) / width(k); };
    diagonal[0] = 2, above[0] = 1, right[0] = 3 * secant(0);
    for (std::size_t k = 1; k < n; ++k) {
      const bool end = k + 1 == n;
      const double below = end ? 1 : 1 / width(k - 1);
      above[k] = end ? 0 : 1 / width(k);
      diagonal[k] = end ? 2 : 2 * (below + above[k]);
      right[k] = end ? 3 * secant(k - 1) : 3 * (secant(k - 1) / width(k - 1) + secant(k) / width(k));
      const double factor = below / diagonal[k - 1];
      diagonal[k] -= factor * above[k - 1];
      right[k] -= factor * right[k - 1];
    }
    std::vector<double> slope(n);
    slope[n - 1] = right[n - 1] / diagonal[n - 1];
    for (std::size_t k = n - 1; k > 0; --k) slope[k - 1] = (right[k - 1] - above[k - 1] * slope[k]) / diagonal[k - 1];
    return slope;
  }

  double first_, last_;
  std::array<double, 2> ends_;
  std::unique_ptr<Spline> spline_;
};

// The curves in units of s0, speed and attraction tau, and what a search for neighbours needs.
struct Flight : Workspace {
  std::vector<double> knots;  // from which the curves are made
  std::unique_ptr<Curve> attraction, speed;
  std::vector<double> hint;  // distance of the last neighbour found, by row
  std::vector<Neighbours::Scratch> nearest;

  // Curves are made anew only when their knots have changed: schedules may move them.
  void shape(std::span<const double> values) {
    if (attraction && std::equal(values.begin(), values.end(), knots.begin(), knots.end())) return;
    knots.assign(values.begin(), values.end());
    attraction = std::make_unique<Curve>(kAttractionAt, values.first(kAttractionKnots));
    speed = std::make_unique<Curve>(kSpeedAt, values.subspan(kAttractionKnots, kSpeedKnots));
  }
};

class Pigeon : public Model {
 public:
  explicit Pigeon(const Setup& setup) : dims_(setup.dims), frame_(setup.reference ? setup.reference->dt() : 0) {}

  std::unique_ptr<Workspace> workspace(const World&, const Rng&) const override { return std::make_unique<Flight>(); }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    auto& flight = static_cast<Flight&>(*c.work);
    const double interval = std::max(c.p[kTau], frame_);
    const auto decision = decision_due(c, interval);
    if (decision) {
      flight.shape(c.p.subspan(kFirstA, kRows - kFirstA));
      flight.hint.resize(static_cast<std::size_t>(now.size()), 0.0);
      flight.nearest.resize(std::max(flight.nearest.size(), agent_threads()));
      c.near.build(now.pos, world.bounds, INFINITY);
    }
    for_each_agent(now.size(), [&](Index i, std::size_t thread) {
      Array3d v = now.vel.row(i).transpose();
      if (decision) v = displacement(now, i, c, interval, *decision, flight, thread) / interval;
      next.vel.row(i) = v.transpose();
      next.pos.row(i) = now.pos.row(i) + c.dt * v.transpose();
    });
    return Step::done;
  }

 private:
  // Until the next decision.
  Array3d displacement(const State& now, Index i, const StepContext& c, double interval, std::uint64_t decision, Flight& flight,
                       std::size_t thread) const {
    const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
    const Array3d u = own_heading(now, i, c.rng, dims_);
    const auto wanted = std::min(static_cast<Index>(std::lround(c.p[kNeighbours])), now.size() - 1);
    const auto found =
        c.near.nearest(i, static_cast<std::size_t>(wanted), INFINITY, flight.hint[static_cast<std::size_t>(i)], flight.nearest[thread]);
    if (found.empty()) return interval * c.p[kSpeed] * c.p[kFirstV + kSpeedKnots - 1] * u + noise(c, interval, decision, id);
    Array3d centre = Array3d::Zero(), moved = Array3d::Zero();
    const Index self = c.near.slot(i);
    for (const auto& other : found) {
      centre += c.near.offset(self, other.slot);
      moved += now.vel.row(c.near.row(other.slot)).transpose();
    }
    const double share = 1 / static_cast<double>(found.size());
    centre *= share;
    const double separation = std::sqrt(centre.square().sum()), s = separation / c.p[kS0];
    const Array3d ahead = interval * c.p[kSpeed] * (*flight.speed)(s)*u;
    const Array3d gap = centre + interval * share * moved - ahead;
    const double wish = std::max(0.0, separation + interval * c.p[kAttraction] * (*flight.attraction)(s));
    return ahead + 0.5 * (std::sqrt(gap.square().sum()) - wish) * heading_of(gap) + noise(c, interval, decision, id);
  }

  Array3d noise(const StepContext& c, double interval, std::uint64_t decision, std::uint32_t id) const {
    Array3d uniform = c.p[kNoise] * interval * white_noise(c.rng, decision, id);
    if (dims_ == 2) uniform[2] = 0;
    return uniform;
  }

  int dims_;
  double frame_;  // frame interval of the recording, or 0
};

void add_knots(std::vector<Parameter>& table, char curve, std::span<const double> at, std::span<const double> values, double most) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    Parameter p;
    p.row = table.size();
    p.name = curve + std::to_string(k);
    p.scene = p.fit = {values[k], curve == 'a' ? -most : 0, most};
    p.meaning = std::string(curve == 'a' ? "change of separation" : "speed") + " at " + std::to_string(at[k]).substr(0, 4) +
                " s0, relative to the curve's scale";
    p.source = "our choice after the text of 2012";
    table.push_back(p);
  }
}

const std::vector<Parameter>& parameter_table() {
  static const std::vector<Parameter> table = [] {
    // Rows longer than a line would be taken apart, one field a line:
    // clang-format off
    std::vector<Parameter> rows{
        {.row = kSpeed, .name = "speed", .symbol = "V", .unit = {1, -1}, .scene = {18, 0.01, 1000}, .fit = {1, 0.1, 4}, .log = true,
         .fitted = true, .meaning = "speed at the separation s0", .source = "our choice after the text of 2012"},
        {.row = kS0, .name = "s0", .symbol = "s_0", .unit = {1, 0}, .scene = {20, 0.01, 1000}, .fit = {0.5, 0.02, 5}, .log = true,
         .fitted = true, .meaning = "separation without attraction or repulsion: scale of both curves", .source = "2012, text"},
        {.row = kAttraction, .name = "attraction", .symbol = "A", .unit = {1, -1}, .scene = {5, 0.001, 1000}, .fit = {0.3, 0.01, 3},
         .log = true, .fitted = true, .meaning = "fastest approach, as a change of separation in time",
         .source = "our choice after the text of 2012"},
        {.row = kNeighbours, .name = "neighbours", .symbol = "m", .unit = {0, 0}, .scene = {50, 1, 1000}, .fit = {7, 1, 50},
         .fitted = true, .meaning = "number of nearest neighbours", .source = "2012: 5 to 50", .integer = true},
        {.row = kNoise, .name = "noise", .symbol = "η", .unit = {1, -1}, .scene = {1, 0, 1000}, .fit = {0.2, 0, 2}, .fitted = true,
         .meaning = "half the width of the error of a displacement, per tau", .source = "our choice; 2012: low enough not to dominate"},
        {.row = kTau, .name = "tau", .symbol = "Δt", .unit = {0, 1}, .scene = {1, 1e-4, 100}, .fit = {0.05, 0.01, 1}, .log = true,
         .fitted = true, .meaning = "time between decisions; at least the recording's frame interval", .source = "our choice"},
    };
    // clang-format on
    constexpr std::array<double, kAttractionKnots> a{1, 0.44, 0, -0.7, -1, -0.6, -0.2, -0.06, 0};
    constexpr std::array<double, kSpeedKnots> v{14.0 / 18, 1, 16.0 / 18, 13.0 / 18, 10.0 / 18, 8.0 / 18, 6.0 / 18};
    add_knots(rows, 'a', kAttractionAt, a, 10);
    add_knots(rows, 'v', kSpeedAt, v, 10);
    return rows;
  }();
  return table;
}

}  // namespace

ModelSpec pigeon_spec() {
  return {.name = "pigeon",
          .summary = "speed and separation follow two curves of the distance to the centre of the nearest neighbours",
          .citation = "Dieck Kattas, Xu and Small 2012, Chaos, arXiv:1204.6547",
          .dims = {2, 3},
          .native_dt = 1,
          .map = "always",
          .quiet = "noise=0",
          .options = {},
          .columns = {},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Pigeon>(setup); }};
}

}  // namespace swarmfit
