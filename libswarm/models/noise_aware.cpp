// SPDX-License-Identifier: MIT
//
// noise_aware – insects carried by a divergence-free noise field
// ===============================================================
// X. Wang, X. Jin, Z. Deng, L. Zhou, Inherent noise-aware insect swarm simulation, Computer Graphics Forum 33(6), 51-62, 2014
// (doi:10.1111/cgf.12277). In free space and without a goal it is the form whose two parameters (scale, gain) Ren et al. 2016
// (doi:10.1371/journal.pone.0155698) fit in their Tables S17-S20. Equations 2, 3 and 9 are the paper's, after Bridson et al. 2007
// (doi:10.1145/1276377.1276435).
//
//   dx/dt = V(x) = curl N(x) + V_g(x)             first order: agents have no inertia, and do not see each other       (9)
//   N     = alpha P + (1 - alpha) (n·P) n         P(x) = gain · Perlin noise of x / scale                           (2)
//   alpha = ramp(d / d0)                          ramp(r) = 15/8 r - 10/8 r³ + 3/8 r⁵, 0 below 0, 1 above 1         (3)
//   d: distance inwards from the cage, a sphere; n: its normal; d0 = scale, at most the radius of the cage
//
// At the cage the flow is tangential, so nobody leaves. (The paper says that alpha grows towards the boundary; its formula says the
// opposite, and is right.) In two dimensions V = (dN/dy, -dN/dx) with the scalar N = alpha P. The root-mean-square speed away from the
// cage is 1.72 gain / scale, 1.00 gain / scale in two dimensions: a smaller scale means finer vortices and, in proportion, faster ones.
//
// In a world with goals V_g = -speed grad C / |grad C| (Eq 8), C the least cost of getting to a goal round the obstacles (paths.h); in a
// goal V_g = 0. Obstacles are boundaries of the noise, too, with d and n of the nearest surface. There curl N is taken by central
// differences over a thousandth of the scale.
//
// The cage is the arena where that is a sphere. Elsewhere its centre is that of the arena or, in a fit, the mean of all recorded
// positions, and its radius is `cage`, or the distance of the farthest recorded position where that is greater: a boundary beyond the
// swarm, as in the paper. Whoever starts outside never gets farther away.
//
// The field is fixed in space and the same for all: agents at one place move alike, and follow the same stream line for ever. Each agent
// is carried by midpoint steps of at most an eighth of d0, whatever the time step. The velocity of the state is V at its position.
//
// Options (first value: default)
//   noise   curl    as above
//           perlin  V proportional to the Perlin noise itself, which is not free of divergence: agents gather in its sinks
//           white   V uniform on a cube, drawn anew for each agent every `hold` seconds
//           perlin and white have the root-mean-square speed of curl noise; near the cage the part of V that points outwards is
//           multiplied by alpha
//   mde     none         agents do not see each other
//           same_cell    those in one cell nearer than d_min are pushed apart after every step (minimum_distance.h), as in the paper; cells
//                        are those of the ways to goals, or without goals ten d_min wide
//           neighbours   the same for all pairs
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "libswarm/centre.h"
#include "libswarm/decision_clock.h"
#include "libswarm/distance_field.h"
#include "libswarm/minimum_distance.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"
#include "libswarm/paths.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kScale, kGain, kCage, kHold, kSpeed, kApart };

enum class Noise { curl, perlin, white };

// What white noise is multiplied by to have the root-mean-square length of curl noise: 1.72 and 1.00 over sqrt(dims / 3).
double white_as_strong_as_curl(int dims) { return dims == 2 ? 1.23 : 1.72; }

constexpr double kTravel = 1.0 / 8;  // longest midpoint step, in units of d0
constexpr int kMostParts = 64;
constexpr double kDifference = 1e-3;  // of the scale, for derivatives near obstacles

// 15/8 r - 10/8 r³ + 3/8 r⁵ and its slope.
struct Ramp {
  double value, slope;
};
Ramp ramp(double r) {
  if (r <= 0) return {0, 0};
  if (r >= 1) return {1, 0};
  const double r2 = r * r;
  return {r * (15 - 10 * r2 + 3 * r2 * r2) / 8, (15 - 30 * r2 + 15 * r2 * r2) / 8};
}

Array3d cross(const Array3d& a, const Array3d& b) { return a.matrix().cross(b.matrix()).array(); }

struct Sphere {
  Array3d centre;
  double radius;
};

struct Field : Workspace {
  explicit Field(const Rng& rng) : noise(rng) {}
  NoiseField noise;
};

// The velocity field of one step.
class Flow {
 public:
  Flow(const NoiseField& field, Noise noise, const World& world, const Sphere& cage, const StepContext& c)
      : field_(field),
        noise_(noise),
        dims_(world.dims),
        cage_(cage),
        walls_(world.part<Walls>()),
        paths_(c.p[kSpeed] > 0 ? world.part<Paths>() : nullptr),
        speed_(c.p[kSpeed]),
        scale_(c.p[kScale]),
        strength_(c.p[kGain] / c.p[kScale]),
        width_(std::min(scale_, cage.radius)),
        rng_(c.rng),
        draw_(decision_tick(c, c.p[kHold])) {}

  Array3d operator()(const Array3d& x, std::uint32_t id) const {
    return paths_ ? Array3d(drift(x, id) + speed_ * paths_->direction(x)) : drift(x, id);
  }

  // Midpoint steps of the stream line through x.
  Array3d carried(Array3d x, std::uint32_t id, double dt) const {
    const double speed = std::sqrt((*this)(x, id).square().sum());
    const double longest = paths_ ? std::min(kTravel * width_, 0.5 * paths_->cell()) : kTravel * width_;
    const int parts = static_cast<int>(std::clamp(std::ceil(speed * dt / longest), 1.0, static_cast<double>(kMostParts)));
    const double h = dt / parts;
    const double farthest = std::max(cage_.radius, std::sqrt((x - cage_.centre).square().sum()));
    for (int k = 0; k < parts; ++k) x = within(farthest, x + h * (*this)(within(farthest, x + 0.5 * h * (*this)(x, id)), id));
    return x;
  }

 private:
  struct Wall {
    Ramp alpha;
    Array3d outward;  // unit vector from the centre
    double r;         // distance from the centre
  };

  Array3d drift(const Array3d& x, std::uint32_t id) const {
    if (walls_)
      if (const Surface s = nearest_surface(walls_->obstacles(), x, dims_, width_); s.distance < width_) return beside(x, s, id);
    const Array3d from = x - cage_.centre;
    const double r = std::sqrt(from.square().sum());
    const double into = (cage_.radius - r) / width_;  // may reach the centre, where there is no direction: the ramp is 1 there
    const Wall wall{ramp(into), r > 0 ? Array3d(from / r) : Array3d(Array3d::Zero()), r};
    if (noise_ == Noise::curl) return strength_ * (into >= 1 ? free_curl(x / scale_) : dims_ == 2 ? curl2(x, wall) : curl3(x, wall));
    const Array3d v = strength_ * (noise_ == Noise::perlin ? potential_as_strong_as_curl(dims_) * field_.potential(x / scale_)
                                                           : white_as_strong_as_curl(dims_) * white_noise(rng_, draw_, id));
    return damped(flat(v), wall);
  }

  // Near an obstacle: the curl of the bent potential by central differences; other noise loses what points into the obstacle.
  Array3d beside(const Array3d& x, const Surface& surface, std::uint32_t id) const {
    if (noise_ != Noise::curl) {
      const Array3d v = strength_ * (noise_ == Noise::perlin ? potential_as_strong_as_curl(dims_) * field_.potential(x / scale_)
                                                             : white_as_strong_as_curl(dims_) * white_noise(rng_, draw_, id));
      return damped(flat(v), {ramp(surface.distance / width_), -surface.outward, 0});
    }
    const double h = kDifference * scale_;
    Eigen::Array33d slope;  // column k: derivative along axis k
    for (Index axis = 0; axis < dims_; ++axis) {
      Array3d step = Array3d::Zero();
      step[axis] = h;
      slope.col(axis) = (bent(x + step) - bent(x - step)) / (2 * h);
    }
    const double gain = strength_ * scale_;
    if (dims_ == 2) return gain * Array3d(slope(0, 1), -slope(0, 0), 0);
    return gain * Array3d(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1));
  }

  // N / gain (Eq 2); in two dimensions its first component alone counts.
  Array3d bent(const Array3d& x) const {
    const Surface s = nearest_surface(walls_->obstacles(), x, dims_);
    const Array3d p = field_.potential(x / scale_);
    const double alpha = ramp(s.distance / width_).value;
    if (dims_ == 2) return alpha * p;
    return alpha * p + (1 - alpha) * (s.outward * p).sum() * s.outward;
  }

  Array3d flat(const Array3d& v) const { return dims_ == 2 ? Array3d(v[0], v[1], 0) : v; }
  Array3d free_curl(const Array3d& u) const { return dims_ == 2 ? field_.curl2(u) : field_.curl(u); }

  // curl N, divided by gain / scale. With u the outward unit vector and s = u·P, N = alpha P + (1 - alpha) s u; curl u = 0, and the
  // gradient of alpha is along u.
  Array3d curl3(const Array3d& x, const Wall& wall) const {
    const auto p = field_.vector_potential(x / scale_);
    const auto& g = p.gradient;
    const Array3d curl(g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1));
    const Array3d& u = wall.outward;
    const Array3d across = p.value - (u * p.value).sum() * u;
    const Array3d slope = (g.colwise() * u).colwise().sum().transpose() + scale_ / wall.r * across;  // scale · grad s
    return wall.alpha.value * curl - scale_ / width_ * wall.alpha.slope * cross(u, p.value) + (1 - wall.alpha.value) * cross(slope, u);
  }

  Array3d curl2(const Array3d& x, const Wall& wall) const {
    const auto p = field_.vector_potential(x / scale_);
    const Array3d gradient =
        wall.alpha.value * p.gradient.row(0).transpose() - scale_ / width_ * wall.alpha.slope * p.value[0] * wall.outward;
    return {gradient[1], -gradient[0], 0};
  }

  static Array3d damped(const Array3d& v, const Wall& wall) {
    const double outward = std::max(0.0, (v * wall.outward).sum());
    return v - (1 - wall.alpha.value) * outward * wall.outward;
  }

  // A step of finite length may overshoot what its stream line does not cross.
  Array3d within(double farthest, const Array3d& x) const {
    const Array3d from = x - cage_.centre;
    const double r = std::sqrt(from.square().sum());
    return r <= farthest ? x : Array3d(cage_.centre + farthest / r * from);
  }

  const NoiseField& field_;
  Noise noise_;
  int dims_;
  Sphere cage_;
  const Walls* walls_;
  const Paths* paths_;
  double speed_;
  double scale_, strength_;
  double width_;  // d0
  Rng rng_;
  std::uint64_t draw_;  // which white velocity it is
};

class NoiseAware : public Model {
 public:
  explicit NoiseAware(const Setup& setup)
      : dims_(setup.dims), noise_(parse_noise(setup.options.at("noise"))), mde_(setup.options.at("mde")), centre_(setup) {
    if (!setup.reference) return;
    const auto& pos = setup.reference->pos();
    const Array3d centre = centre_.in({});
    for (Index i = 0; i < pos.rows(); ++i) reach_ = std::max(reach_, std::sqrt((pos.row(i).transpose() - centre).square().sum()));
  }

  std::unique_ptr<Workspace> workspace(const World&, const Rng& rng) const override { return std::make_unique<Field>(rng); }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    const Flow flow(static_cast<const Field*>(c.work)->noise, noise_, world, cage(world.bounds, c), c);
    for_each_agent(now.size(), [&](Index i, std::size_t) {
      const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
      const Array3d x = flow.carried(now.pos.row(i).transpose(), id, c.dt);
      next.pos.row(i) = x.transpose();
      next.vel.row(i) = flow(x, id).transpose();
    });
    if (mde_ != "none" && c.p[kApart] > 0) c.count.enforced += enforce({c.p[kApart], cell(world, c)}, next, world, c);
    return Step::done;
  }

 private:
  static Noise parse_noise(const std::string& name) {
    return name == "perlin" ? Noise::perlin : name == "white" ? Noise::white : Noise::curl;
  }

  double cell(const World& world, const StepContext& c) const {
    if (mde_ == "neighbours") return 0;
    const auto* paths = world.part<Paths>();
    return paths ? paths->cell() : 10 * c.p[kApart];
  }

  Sphere cage(const Bounds& bounds, const StepContext& c) const {
    Sphere cage{centre_.in(bounds), std::max(c.p[kCage], reach_)};
    if (bounds.kind == Bounds::Kind::sphere) cage = {bounds.centre, bounds.radius};
    if (dims_ == 2) cage.centre[2] = 0;
    return cage;
  }

  int dims_;
  Noise noise_;
  std::string mde_;
  SwarmCentre centre_;
  double reach_ = 0;  // of the recorded positions from their centre; 0 without a recording
};

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kScale, .name = "scale", .symbol = "scale", .unit = {1, 0}, .scene = {2.1368, 0.05, 20}, .fit = {0.5, 0.15, 2}, .log = true,
       .fitted = true, .published = true, .when = "noise=curl|perlin", .meaning = "feature size of the noise field", .source = "Table S17"},
      {.row = kGain, .name = "gain", .symbol = "gain", .unit = {2, -1}, .scene = {1.2394, 0.01, 20}, .fit = {0.35, 0.05, 2.5}, .log = true,
       .fitted = true, .published = true, .meaning = "amplitude of the potential; the speed is 1.72 gain / scale", .source = "Table S17"},
      {.row = kCage, .name = "cage", .symbol = "R", .unit = {1, 0}, .scene = {10, 0.1, 1000}, .fit = {3, 1, 10}, .log = true,
       .fitted = true,
       .meaning = "radius of the cage; in a fit it holds at least all recorded positions",
       .source = "our choice: beyond the swarm, as in section 4 of the paper"},
      {.row = kHold, .name = "hold", .symbol = "τ", .unit = {0, 1}, .scene = {1.0 / 60, 1e-4, 10}, .fit = {0.05, 0.001, 10}, .log = true,
       .when = "noise=white", .meaning = "how long a white velocity lasts", .source = "our choice: the paper's frame"},
      {.row = kSpeed, .name = "speed", .symbol = "s0", .unit = {1, -1}, .scene = {0, 0, 100}, .fit = {0, 0, 10}, .needs = "goals",
       .meaning = "speed towards a goal", .source = "Eq 8; Table 1"},
      {.row = kApart, .name = "d_min", .symbol = "d_min", .unit = {1, 0}, .scene = {0.01, 0, 10}, .fit = {0.01, 0, 1},
       .when = "mde=same_cell|neighbours", .meaning = "distance below which agents are pushed apart",
       .source = "our choice: a tenth of a cell of 0.1; the paper does not give it"},
  };
  // clang-format on
  return table;
}

}  // namespace

ModelSpec noise_aware_spec() {
  return {.name = "noise_aware",
          .summary = "agents carried by a divergence-free noise field inside a cage, without interaction",
          .citation = "Wang et al. 2014, doi:10.1111/cgf.12277; fitted by Ren et al. 2016, doi:10.1371/journal.pone.0155698",
          .dims = {2, 3},
          .native_dt = 1.0 / 60,
          .largest_dt = 1.0 / 40,  // a midpoint step of L / 40 at the recorded speed, a sixth of the smallest scale
          .quiet = "gain=0",
          .options = {{"noise",
                       {"curl", "perlin", "white"},
                       "the velocity field",
                       {"a smooth field of velocities without sources and sinks",
                        "a smooth field of velocities in whose sinks agents gather", "random velocities of its own for each agent"}},
                      {"mde",
                       {"none", "same_cell", "neighbours"},
                       "minimum-distance enforcement",
                       {"no minimum distance", "a minimum distance within cells of a grid", "a minimum distance between agents"}}},
          .columns = {},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<NoiseAware>(setup); }};
}

}  // namespace swarmfit
