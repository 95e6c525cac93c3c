// SPDX-License-Identifier: MIT
//
// continuum_crowds – people who steer by the density and flow of the crowd
// =========================================================================
// A. Treuille, S. Cooper, Z. Popović, Continuum crowds, ACM Transactions on Graphics 25(3), 1160-1168, 2006
// (doi:10.1145/1141911.1142008); with noise the baseline of X. Wang et al., Computer Graphics Forum 33(6), 2014
// (doi:10.1111/cgf.12277), section 7.1. In the plane, in a world with goals, on the grid of its ways (paths.h).
//
//   density   rho    every agent gives the four cells about it min(1 - dx, 1 - dy)^lambda and so on: at least 2^-lambda its own, at most
//                    that to others;  mean velocity  u = sum rho_i v_i / rho
//   speed     f(n)   towards the next cell in direction n: `speed` where its rho <= rho_min, u·n where rho >= rho_max, linear in rho
//                    between; at least a hundredth of `speed`
//   cost      C(n) = (alpha f + beta + gamma g) / f        g: the repulsion of obstacles at the next cell; infinite into obstacles
//   way       |grad phi| = C in the direction of grad phi, phi = 0 in the goal
//   velocity  dx/dt = -f grad phi / |grad phi|, interpolated between cells; 0 in the goal
//
// Everything is found anew in every step. With several kinds of agents the first heads for the first goal, the second for the second, and
// everybody else for the last; one kind alone heads for the cheapest of all. Who can reach none stands. In a
// world without goals everybody walks on along its heading at `speed`. Nobody is aware of anybody but by density and flow; agents nearer
// than d_min are pushed apart after every step (minimum_distance.h).
//
// Options (first value: default)
//   noise   none    as above
//           perlin  a velocity proportional to Perlin noise of x / scale, of root-mean-square length `agitation`, is added
//           white   a velocity uniform on a square, drawn anew for each agent and step, of the same length
#include <algorithm>
#include <cmath>
#include <limits>

#include "libswarm/agitation.h"
#include "libswarm/directed_cost.h"
#include "libswarm/distance_field.h"
#include "libswarm/headings.h"
#include "libswarm/minimum_distance.h"
#include "libswarm/parallel.h"
#include "libswarm/paths.h"

namespace swarmfit {
namespace {

using Eigen::Array2d;
using Eigen::Array3d;
using Faces = DirectedCostField::Faces;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kSpeed, kRhoMin, kRhoMax, kLambda, kAlpha, kBeta, kGamma, kAgitation, kScale, kApart };

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kSlowest = 0.01;  // of the free speed: costs stay finite

Array3d in_plane(const Array3d& a) { return {a[0], a[1], 0}; }

// The four cell centres about a place, and what they have in an interpolation between them. Cells beyond the grid are -1.
struct Corners {
  std::array<Index, 4> cell{};  // lower left, lower right, upper left, upper right
  double dx = 0, dy = 0;        // from the first, in cells

  Corners(const FieldGrid& grid, const Array3d& place) {
    const double x = (place[0] - grid.lower[0]) / grid.cell - 0.5, y = (place[1] - grid.lower[1]) / grid.cell - 0.5;
    const auto i = static_cast<Index>(std::floor(x)), j = static_cast<Index>(std::floor(y));
    dx = x - std::floor(x), dy = y - std::floor(y);
    for (std::size_t k = 0; k < 4; ++k) {
      const Index a = i + static_cast<Index>(k % 2), b = j + static_cast<Index>(k / 2);
      cell[k] = a < 0 || b < 0 || a >= grid.count[0] || b >= grid.count[1] ? -1 : grid.index(a, b, 0);
    }
  }

  std::array<double, 4> bilinear() const { return {(1 - dx) * (1 - dy), dx * (1 - dy), (1 - dx) * dy, dx * dy}; }
  std::array<double, 4> splat(double lambda) const {
    const auto share = [&](double a, double b) { return std::pow(std::min(a, b), lambda); };
    return {share(1 - dx, 1 - dy), share(dx, 1 - dy), share(1 - dx, dy), share(dx, dy)};
  }
};

// What the crowd is like in every cell.
struct Crowd {
  std::vector<double> density;
  std::vector<Array2d> velocity;  // mean

  Crowd(const FieldGrid& grid, const State& now, double lambda)
      : density(static_cast<std::size_t>(grid.cells()), 0), velocity(density.size(), Array2d::Zero()) {
    for (Index i = 0; i < now.size(); ++i) {
      const Corners corners(grid, now.pos.row(i).transpose());
      const auto share = corners.splat(lambda);
      for (std::size_t k = 0; k < 4; ++k) {
        if (corners.cell[k] < 0) continue;
        const auto c = static_cast<std::size_t>(corners.cell[k]);
        density[c] += share[k];
        velocity[c] += share[k] * now.vel.row(i).head<2>().transpose();
      }
    }
    for (std::size_t c = 0; c < density.size(); ++c)
      if (density[c] > 0) velocity[c] /= density[c];
  }
};

// What does not change between steps, as long as nobody moves the walls.
struct Ground : Workspace {
  Ground(const Rng& rng, const Paths* paths, const Walls* walls) : noise(rng) {
    if (!paths) return;
    const FieldGrid& grid = paths->field().grid();
    for (Index c = 0; c < grid.cells(); ++c) {
      const Array3d centre = in_plane(grid.centre(c));
      const double distance = walls ? nearest_surface(walls->obstacles(), centre, 2).distance : kNever;
      solid.push_back(distance <= 0);
      discomfort.push_back(distance <= 0 ? 0 : repulsion(distance, paths->reach()));
    }
  }
  NoiseField noise;
  std::vector<bool> solid;
  std::vector<double> discomfort;  // g
};

// Velocities of all who head for the same goal.
class Flow {
 public:
  Flow(const Paths& paths, const Ground& ground, const Crowd& crowd, const std::vector<bool>& goal, std::span<const double> p)
      : grid_(paths.field().grid()),
        velocity_(static_cast<std::size_t>(grid_.cells()), Array2d::Zero()),
        blocked_(velocity_.size(), false) {
    std::vector<Faces> speed(velocity_.size()), slowness(velocity_.size());
    for (Index c = 0; c < grid_.cells(); ++c) {
      const auto place = grid_.at(c);
      for (std::size_t face = 0; face < kFaces.size(); ++face) {
        const Index i = place[0] + kFaces[face][0], j = place[1] + kFaces[face][1];
        const auto s = static_cast<std::size_t>(c);
        slowness[s][face] = kNever;
        if (i < 0 || j < 0 || i >= grid_.count[0] || j >= grid_.count[1]) continue;
        const auto next = static_cast<std::size_t>(grid_.index(i, j, 0));
        if (ground.solid[next]) continue;
        const double f = speed[s][face] = towards(crowd, next, face, p);
        slowness[s][face] = (p[kAlpha] * f + p[kBeta] + p[kGamma] * ground.discomfort[next]) / f;
      }
    }
    const DirectedCostField field(grid_, std::move(slowness), goal);
    for (Index c = 0; c < grid_.cells(); ++c) {
      const auto s = static_cast<std::size_t>(c);
      blocked_[s] = ground.solid[s] || field.cost(c) == kNever;
      const Faces down = field.downhill(c);
      for (std::size_t face = 0; face < kFaces.size(); ++face)
        velocity_[s] += down[face] * speed[s][face] * Array2d(kFaces[face][0], kFaces[face][1]);
    }
    goal_ = goal;
  }

  // Between the centres of cells that are free.
  Array2d operator()(const Array3d& place) const {
    if (goal_[static_cast<std::size_t>(grid_.cell_of(place))]) return Array2d::Zero();
    const Corners corners(grid_, place);
    const auto share = corners.bilinear();
    Array2d sum = Array2d::Zero();
    double weight = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      if (corners.cell[k] < 0 || blocked_[static_cast<std::size_t>(corners.cell[k])]) continue;
      sum += share[k] * velocity_[static_cast<std::size_t>(corners.cell[k])];
      weight += share[k];
    }
    return weight > 0 ? Array2d(sum / weight) : sum;
  }

 private:
  static double towards(const Crowd& crowd, std::size_t next, std::size_t face, std::span<const double> p) {
    const double with_flow = crowd.velocity[next][0] * kFaces[face][0] + crowd.velocity[next][1] * kFaces[face][1];
    const double dense = p[kRhoMax] > p[kRhoMin] ? std::clamp((crowd.density[next] - p[kRhoMin]) / (p[kRhoMax] - p[kRhoMin]), 0.0, 1.0)
                                                 : (crowd.density[next] > p[kRhoMin] ? 1.0 : 0.0);
    return std::max(kSlowest * p[kSpeed], p[kSpeed] + dense * (std::max(0.0, with_flow) - p[kSpeed]));
  }

  const FieldGrid& grid_;
  std::vector<Array2d> velocity_;
  std::vector<bool> blocked_, goal_;
};

class ContinuumCrowds : public Model {
 public:
  explicit ContinuumCrowds(const Setup& setup) : kinds_(setup.kinds), agitation_(setup.options.at("noise"), 2) {}

  std::unique_ptr<Workspace> workspace(const World& world, const Rng& rng) const override {
    return std::make_unique<Ground>(rng, world.part<Paths>(), world.part<Walls>());
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    const auto& ground = *static_cast<const Ground*>(c.work);
    const std::vector<Flow> flows = flows_of(now, world, ground, c.p);
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      const Array3d x = now.pos.row(i).transpose();
      const auto row = static_cast<std::size_t>(i);
      Array3d v = agitation_.velocity(ground.noise, x, c.p[kAgitation], c.p[kScale], c.rng, c.tick, now.id[row]);
      if (flows.empty())
        v += c.p[kSpeed] * heading_of(now.vel.row(i).transpose());
      else
        v.head<2>() += flows[std::min<std::size_t>(now.kind[row], flows.size() - 1)](x);
      next.vel.row(i) = v.transpose();
      next.pos.row(i) = (x + c.dt * v).transpose();
    });
    if (c.p[kApart] > 0) c.count.enforced += enforce({c.p[kApart], 0}, next, world, c);
    return Step::done;
  }

 private:
  // One for each goal that a kind heads for by itself, or one for all goals.
  std::vector<Flow> flows_of(const State& now, const World& world, const Ground& ground, std::span<const double> p) const {
    std::vector<Flow> out;
    const auto* paths = world.part<Paths>();
    if (!paths) return out;
    const FieldGrid& grid = paths->field().grid();
    const Crowd crowd(grid, now, p[kLambda]);
    const std::size_t groups = std::min(static_cast<std::size_t>(std::max(1, kinds_)), paths->size());
    for (std::size_t group = 0; group < groups; ++group) {
      std::vector<bool> goal(static_cast<std::size_t>(grid.cells()), false);
      for (Index cell = 0; cell < grid.cells(); ++cell)
        for (std::size_t k = 0; k < paths->size(); ++k)
          if ((groups == 1 || k == group) && paths->holds(k, in_plane(grid.centre(cell)))) goal[static_cast<std::size_t>(cell)] = true;
      out.emplace_back(*paths, ground, crowd, goal, p);
    }
    return out;
  }

  int kinds_;
  Agitation agitation_;
};

const std::vector<Parameter>& parameter_table() {
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kSpeed, .name = "speed", .symbol = "f_max", .unit = {1, -1}, .scene = {1.5, 0.01, 100}, .fit = {1, 0.3, 3}, .log = true,
       .fitted = true, .meaning = "speed where nobody is in the way", .source = "section 4.1; s0 of Wang et al."},
      {.row = kRhoMin, .name = "rho_min", .symbol = "ρ_min", .scene = {0.32, 0, 10}, .fit = {0.32, 0, 10}, .needs = "goals",
       .meaning = "density, in agents per cell, up to which the crowd does not slow anybody", .source = "section 4.1"},
      {.row = kRhoMax, .name = "rho_max", .symbol = "ρ_max", .scene = {0.8, 0, 10}, .fit = {0.8, 0, 10}, .needs = "goals",
       .meaning = "density from which everybody walks with the crowd", .source = "section 4.1"},
      {.row = kLambda, .name = "lambda", .symbol = "λ", .scene = {1.5, 0.1, 10}, .fit = {1.5, 0.1, 10}, .needs = "goals",
       .meaning = "how fast an agent's density falls off; it gives its own cell at least 2^-λ", .source = "section 4.1"},
      {.row = kAlpha, .name = "alpha", .symbol = "α", .scene = {1, 0, 100}, .fit = {1, 0, 100}, .needs = "goals",
       .meaning = "weight of the length of a way", .source = "section 3"},
      {.row = kBeta, .name = "beta", .symbol = "β", .unit = {1, -1}, .scene = {1, 0, 100}, .fit = {1, 0, 100}, .needs = "goals",
       .meaning = "weight of the time that it takes", .source = "section 3"},
      {.row = kGamma, .name = "gamma", .symbol = "γ", .unit = {1, -1}, .scene = {1, 0, 100}, .fit = {1, 0, 100}, .needs = "goals",
       .meaning = "weight of being near obstacles", .source = "section 3"},
      {.row = kAgitation, .name = "agitation", .unit = {1, -1}, .scene = {0.3, 0, 100}, .fit = {0.3, 0.03, 1}, .log = true, .fitted = true,
       .when = "noise=perlin|white", .meaning = "root-mean-square velocity of the noise", .source = "Wang et al., section 7.1"},
      {.row = kScale, .name = "scale", .unit = {1, 0}, .scene = {0.4, 0.01, 100}, .fit = {0.5, 0.05, 5}, .log = true, .fitted = true,
       .when = "noise=perlin", .meaning = "feature size of the noise", .source = "Wang et al., section 7.1"},
      {.row = kApart, .name = "d_min", .symbol = "d_min", .unit = {1, 0}, .scene = {0.05, 0, 10}, .fit = {0.01, 0, 1},
       .meaning = "distance below which agents are pushed apart", .source = "section 4.5; our choice"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec continuum_crowds_spec() {
  return {.name = "continuum_crowds",
          .summary = "people who steer by the density and flow of the crowd",
          .citation = "Treuille, Cooper and Popović 2006, doi:10.1145/1141911.1142008",
          .dims = {2},
          .native_dt = 1.0 / 30,
          .largest_dt = 1.0 / 10,
          .quiet = "noise=none",
          .options = {{"noise",
                       {"none", "perlin", "white"},
                       "a velocity that is added",
                       {"no noise", "a smooth field of velocities that all share", "random velocities of its own for each agent"}}},
          .columns = {},
          .kinds = {"first", "second"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<ContinuumCrowds>(setup); }};
}

}  // namespace swarmfit
