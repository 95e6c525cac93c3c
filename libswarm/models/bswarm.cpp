// SPDX-License-Identifier: MIT
//
// bswarm – insect swarms by noise-driven second-order dynamics with collision avoidance
// ======================================================================================
// J. Ren, X. Wang, X. Jin, D. Manocha, Simulating flying insects using dynamics and data-driven noise modeling to generate diverse
// collective behaviors, PLoS ONE 11(5): e0155698, 2016 (doi:10.1371/journal.pone.0155698). Numbers of equations are the paper's.
//
//   dv/dt  = F_int + F_fric + F_res + F_noise                                                                       (2, 3)
//   F_int  = sum over zones k of  chi_k / N_k · sum over j in zone k of  g rhat + (1 - |g|) vhat                     (5)
//            rhat: unit vector from i to j; vhat: unit vector of v_j - v_i; N_k: neighbours in the zone; empty zone: 0
//            repulsion   g = -1   0              <= r <  r_rep
//            alignment   g =  0   r_rep          <= r <  r_rep + r_ali*
//            attraction  g = +1   r_rep + r_ali* <= r <= r_rep + r_ali* + r_att*
//   F_fric = -gamma |v| v
//   F_res  = chi_res (R(theta) s or -s) for the nearest stimulus within r_res, s the unit vector from it to the agent: flight from a
//            repelling one at an angle theta, uniform on [-pi/2, 0] about the y axis (in two dimensions z) and drawn once per encounter;
//            straight to an attracting one
//   F_noise: option `noise`, below
//   v_pref = v + F dt;  v = collision-free velocity nearest to v_pref;  r = r + v dt       (Algorithm 1; synchronous, semi-implicit Euler)
//
// White and Gaussian noise with sde scaling stand for continuous noise: where it takes an agent within a step is drawn, too, so that
// positions have the statistics of the continuous process (brownian.cpp says which). With literal scaling kicks belong to the step: the
// model is a map from frame to frame.
//
// Radii are stored as the widths of the zones' shells (starred), so that r_att >= r_ali >= r_rep >= 0 holds by construction.
// The printed equations collapse the swarm of Table 1 to a clump whose size is set by the avoidance radius alone, which the paper does not
// give: report nearest-neighbour distances with every result.
//
// Options (first value: default)
//   noise          curl      curl P(r / scale), fixed in space: agents at one place feel the same force
//                  perlin    P(r / scale), likewise
//                  gaussian  lambda · G, G standard normal per component, new for each agent and step
//                  white     sqrt(3) lambda · W, W uniform on [-1, 1) per component, likewise; with literal scaling lambda · W
//                  ou        a control: the force of every agent by itself, with a memory of time tau: d eta = -eta / tau dt +
//                            noise sqrt(2 / tau) dW per component (Uhlenbeck & Ornstein, Phys. Rev. 36: 823, 1930)
//                  none      0
//                  `noise` is the root mean square of the force per component, whatever its kind: of the paper's curl noise gain / scale
//                  times 0.996 (in two dimensions 0.709), of its Perlin noise gain times 0.27. `lambda` is the same of what has no memory,
//                  times the square root of time: in a time t it changes velocities by lambda sqrt(t) per component. All strengths are
//                  searched between the same bounds, in units of L / T² and L / T^1.5
//   interaction    on | off: F_int = 0 (the paper's "noise only")
//   avoidance      orca | none
//   infeasible     when no velocity is free of collisions: zero velocity | substep: redo the step in halves, thrice at most, then zero |
//                  min_penetration: the least bad velocity
//   drag           explicit | implicit: v_pref = (v + F' dt) / (1 + gamma |v| dt), stable for any step. The explicit step is halved while
//                  gamma |v| dt > 1 for anybody
//   noise_scaling  sde: white and Gaussian forces are divided by sqrt(dt), so that diffusion does not depend on dt | literal: as printed
//   align          literal | soft: vhat shrinks with the difference of velocities below chi_ali dt, which stops chatter
//   offset         shared | per_agent: every agent has a noise field of its own
//   response       one: everybody veers to the same side, as printed | both: sides are drawn
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "libswarm/avoider.h"
#include "libswarm/linear_noise.h"
#include "libswarm/model.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"
#include "libswarm/stimuli.h"
#include "libswarm/zones.h"
#include "libtrack/normals.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Root mean square per component of NoiseField's curl() or curl2(), and of its potential(): expected values over all hashes and places in
// a cell.
double rms_curl(int dims) { return dims == 2 ? 0.7095 : 0.9962; }
constexpr double kRmsPotential = 0.27;

// Rows of the parameter table, in its order.
enum Row : std::size_t {
  kGamma,
  kNoise,
  kScale,
  kTau,
  kLambda,
  kLambdaLiteral,
  kChiRep,
  kChiAtt,
  kRRep,
  kRAtt,
  kChiAli,
  kRAli,
  kChiRes,
  kRRes,
  kRadius,
  kMaxSpeed,
  kTimeHorizon,
  kNeighbourDistance,
  kMaxNeighbours
};

// Private columns: the stimulus being met (its index + 1; 0: none), the angle drawn for it, and the force of noise=ou (three components).
enum : Index { kStimulus, kTheta, kEta };
constexpr Index kColumns = kEta + 3;

const std::vector<Option>& option_table() {
  static const std::vector<Option> table{
      {"noise",
       {"curl", "perlin", "gaussian", "white", "ou", "none"},
       "random force",
       {"curl noise (a smooth field of forces without sources and sinks)", "Perlin noise (a smooth field of forces)",
        "Gaussian noise (random forces without memory)", "white noise (random forces without memory, uniform between bounds)",
        "a random force of its own for each agent (with a memory of time tau, no field)", "no noise"}},
      {"interaction",
       {"on", "off"},
       "repulsion, alignment and attraction between agents",
       {"forces between agents", "no forces between agents"}},
      {"avoidance", {"orca", "none"}, "reciprocal collision avoidance", {"collision avoidance", "no collision avoidance"}},
      {"infeasible",
       {"zero", "substep", "min_penetration"},
       "what to do when every velocity leads to a collision",
       {"a halt where every velocity leads to a collision", "steps in halves where every velocity leads to a collision",
        "the least bad velocity where every one leads to a collision"}},
      {"drag", {"explicit", "implicit"}, "how the quadratic drag is stepped", {"explicit steps of drag", "implicit steps of drag"}},
      {"noise_scaling",
       {"sde", "literal"},
       "white and Gaussian noise: independent of the time step, or as printed",
       {"noise that does not depend on the time step", "noise once per step, as printed in the paper"}},
      {"align",
       {"literal", "soft"},
       "alignment force: constant magnitude, or fading with the difference of velocities",
       {"an alignment of constant strength", "an alignment that fades with the difference of velocities"}},
      {"offset",
       {"shared", "per_agent"},
       "one noise field for all, or one for each agent",
       {"one noise field for all", "a noise field of its own for each agent"}},
      {"response", {"one", "both"}, "flight from a stimulus: to one side, or to either", {"flight to one side", "flight to either side"}},
  };
  return table;
}

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  constexpr const char *field = "noise=curl|perlin", *force = "noise=curl|perlin|ou", *memory = "noise=ou", *on = "interaction=on",
                       *orca = "avoidance=orca";
  constexpr const char *sde = "noise=white|gaussian,noise_scaling=sde", *literal = "noise=white|gaussian,noise_scaling=literal";
  // Rows longer than a line would be taken apart, one field a line:
  // clang-format off
  static const std::vector<Parameter> table{
      {.row = kGamma, .name = "gamma", .symbol = "γ", .unit = {-1, 0}, .scene = {11.16, 0.1, 20}, .fit = {1.5, 0.1, 20}, .log = true,
       .fitted = true, .published = true, .meaning = "quadratic drag", .source = "Eq 3; Table 1 Midge"},
      {.row = kNoise, .name = "noise", .symbol = "σ", .unit = {1, -2}, .scene = {0.9962 * 2.51 / 2.20, 0, 40}, .fit = {2, 0, 20},
       .fitted = true, .published = true, .when = force,
       .meaning = "root mean square of the noise force, per component", .source = "Eq 4; Table 1 Midge: 0.996 gain / scale"},
      {.row = kScale, .name = "scale", .symbol = "scale", .unit = {1, 0}, .scene = {2.20, 0.2, 5}, .fit = {0.5, 0.1, 3}, .log = true,
       .fitted = true, .published = true, .when = field,
       .meaning = "feature size of the noise field", .source = "Eq 4; Table 1 Midge",
       .at_lower = "the smaller the features, the nearer a field is to white noise"},
      {.row = kTau, .name = "tau", .symbol = "τ", .unit = {0, 1}, .scene = {0.1, 0.001, 10}, .fit = {0.2, 0.02, 2}, .log = true,
       .fitted = true, .when = memory, .meaning = "memory of the noise force", .source = "a control, not in the paper",
       .at_lower = "the shorter its memory, the nearer the force is to white noise"},
      {.row = kLambda, .name = "lambda", .symbol = "λ", .unit = {1, -1.5}, .scene = {1, 0, 20}, .fit = {2, 0, 20}, .fitted = true,
       .published = true, .when = sde,
       .meaning = "root mean square of the noise force, per component, times the square root of time", .source = "Eq 4"},
      {.row = kLambdaLiteral, .name = "lambda_literal", .symbol = "λ", .unit = {1, -2}, .scene = {1, 0, 20}, .fit = {5, 0, 20},
       .fitted = true, .published = true, .when = literal, .meaning = "amplitude of the random force, as printed", .source = "Eq 4"},
      {.row = kChiRep, .name = "chi_rep", .symbol = "χ_rep", .unit = {1, -2}, .scene = {5.61, 0, 30}, .fit = {5, 0, 20}, .fitted = true, .published = true,
       .when = on, .meaning = "repulsion", .source = "Eq 5; Table 1 Midge"},
      {.row = kChiAtt, .name = "chi_att", .symbol = "χ_att", .unit = {1, -2}, .scene = {14.29, 0, 40}, .fit = {5, 0, 20}, .fitted = true, .published = true,
       .when = on, .meaning = "attraction", .source = "Eq 5; Table 1 Midge"},
      {.row = kRRep, .name = "r_rep", .symbol = "r_rep", .unit = {1, 0}, .scene = {0.17, 0, 8}, .fit = {0.5, 0, 3}, .length = spacing,
       .fitted = true, .published = true, .when = on, .meaning = "radius of repulsion", .source = "Eq 5; Table 1 Midge"},
      {.row = kRAtt, .name = "r_att", .symbol = "r_att*", .unit = {1, 0}, .scene = {5.12, 0, 20}, .fit = {5, 0, 10}, .length = spacing,
       .fitted = true, .published = true, .when = on, .meaning = "width of the shell of attraction", .source = "Eq 5; Table 1 Midge"},
      {.row = kChiAli, .name = "chi_ali", .symbol = "χ_ali", .unit = {1, -2}, .scene = {0, 0, 20}, .fit = {0, 0, 20}, .when = on,
       .meaning = "alignment", .source = "Eq 5; Table 1 Midge"},
      {.row = kRAli, .name = "r_ali", .symbol = "r_ali*", .unit = {1, 0}, .scene = {0, 0, 12}, .fit = {0, 0, 10}, .length = spacing,
       .when = on, .meaning = "width of the shell of alignment", .source = "Eq 5; Table 1 Midge"},
      {.row = kChiRes, .name = "chi_res", .symbol = "χ_res", .unit = {1, -2}, .scene = {0, 0, 60}, .fit = {0, 0, 60},
       .needs = "stimuli", .meaning = "response to stimuli", .source = "Eq 3; Table 1 Midge"},
      {.row = kRRes, .name = "r_res", .symbol = "r_res", .unit = {1, 0}, .scene = {0, 0, 25}, .fit = {0, 0, 25},
       .needs = "stimuli", .meaning = "range of sight for stimuli", .source = "Eq 3; Table 1 Midge"},
      {.row = kRadius, .name = "radius", .symbol = "r", .unit = {1, 0}, .scene = {0.07, 0.001, 1}, .fit = {0.05, 0.01, 1},
       .length = spacing, .log = true, .fitted = true, .when = orca,
       .meaning = "radius of an agent for avoidance",
       .source = "our choice; the fits of the avoidance baseline, Tables S17-S20, give 0.063-0.078"},
      {.row = kMaxSpeed, .name = "max_speed", .symbol = "v_max", .unit = {1, -1}, .scene = {10, 0.1, 1000}, .fit = {50, 1, 1000},
       .log = true, .when = orca, .meaning = "highest speed; must not clip v_pref", .source = "our choice"},
      {.row = kTimeHorizon, .name = "time_horizon", .symbol = "τ", .unit = {0, 1}, .scene = {0.5, 0.01, 10}, .fit = {0.5, 0.01, 10},
       .log = true, .when = orca, .meaning = "for how long collisions are avoided", .source = "our choice"},
      {.row = kNeighbourDistance, .name = "neighbour_distance", .symbol = "d_max", .unit = {1, 0}, .scene = {0, 0, 40}, .fit = {0, 0, 40},
       .length = spacing, .when = orca, .meaning = "range of avoidance; 0: ten times the radius", .source = "our choice; Table S17 0.4022"},
      {.row = kMaxNeighbours, .name = "max_neighbours", .symbol = "k", .unit = {0, 0}, .scene = {10, 1, 100}, .fit = {10, 1, 100},
       .when = orca, .meaning = "most neighbours avoided at once", .source = "Table S17 10.6", .integer = true},
  };
  // clang-format on
  return table;
}

struct Buffers : Workspace {
  Buffers(int dims, Infeasible infeasible) : avoider(dims, infeasible) {}
  std::optional<NoiseField> field;  // of the noises that have one
  GaussianNoise gaussian, area, third;
  std::array<double, 3> of{};  // step, tau and strength of the memory
  LinearNoise<3> memory;       // of (what the force adds to the place, to the velocity, the force)
  Avoider avoider;
};

class Bswarm : public Model {
 public:
  explicit Bswarm(const Setup& setup)
      : dims_(setup.dims),
        noise_(parse_noise(setup.options.at("noise"))),
        infeasible_(parse_infeasible(setup.options.at("infeasible"))),
        interaction_(setup.options.at("interaction") == "on"),
        avoidance_(setup.options.at("avoidance") == "orca"),
        implicit_drag_(setup.options.at("drag") == "implicit"),
        sde_(setup.options.at("noise_scaling") == "sde"),
        continuous_(sde_ && (noise_ == Noise::white || noise_ == Noise::gaussian)),
        soft_alignment_(setup.options.at("align") == "soft"),
        per_agent_offset_(setup.options.at("offset") == "per_agent"),
        both_sides_(setup.options.at("response") == "both") {}

  Index columns() const override { return kColumns; }
  std::unique_ptr<Workspace> workspace(const World&, const Rng& rng) const override {
    auto buffers = std::make_unique<Buffers>(dims_, infeasible_);
    if (noise_ == Noise::curl || noise_ == Noise::perlin) buffers->field.emplace(rng);
    return buffers;
  }

  // The force of memory is drawn from its stationary law.
  void enter(State& state, Index first, const World&, const StepContext& c) const override {
    if (noise_ != Noise::ou) return;
    for (Index i = first; i < state.size(); ++i) {
      const Array3d eta = c.p[kNoise] * three_normals(c.rng, Stream::hidden, c.tick, state.id[static_cast<std::size_t>(i)]);
      state.own.row(i).segment(kEta, 3) = flat(eta).transpose();
    }
  }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    if (!implicit_drag_ && c.can_halve && too_fast(now, c)) return Step::halve_dt;
    Buffers& buffers = *static_cast<Buffers*>(c.work);
    prepare(now, world, c, buffers);
    const auto* stimuli = c.p[kChiRes] > 0 ? world.part<Stimuli>() : nullptr;
    for_each_agent(now.size(), [&](Index i, std::size_t thread) {
      Array3d force = noise(now, i, c);
      if (interaction_) force += interaction(now, i, c);
      if (stimuli) force += response(now, next, i, *stimuli, world.bounds, c);
      Array3d v = preferred(now.vel.row(i).transpose(), force, c);
      if (avoidance_) v = buffers.avoider.velocity(now, i, v, c, thread);
      const Array3d within = continuous_ ? astray(now, i, c) : noise_ == Noise::ou ? remembered(now, next, i, c) : Array3d(Array3d::Zero());
      for (Index axis = 0; axis < 3; ++axis) {
        next.vel(i, axis) = v[axis];
        next.pos(i, axis) = now.pos(i, axis) + v[axis] * c.dt + within[axis];
      }
    });
    return avoidance_ ? buffers.avoider.end(c) : Step::done;
  }

 private:
  enum class Noise { curl, perlin, gaussian, white, ou, none };

  static Noise parse_noise(std::string_view name) {
    if (name == "curl") return Noise::curl;
    if (name == "perlin") return Noise::perlin;
    if (name == "gaussian") return Noise::gaussian;
    if (name == "ou") return Noise::ou;
    return name == "white" ? Noise::white : Noise::none;
  }

  // The explicit drag step reverses the motion of anybody with gamma |v| dt > 1.
  static bool too_fast(const State& now, const StepContext& c) {
    const double limit = 1 / (c.p[kGamma] * c.dt);
    double fastest2 = 0;
    for (Index i = 0; i < now.size(); ++i) {
      const double vx = now.vel(i, 0), vy = now.vel(i, 1), vz = now.vel(i, 2);
      fastest2 = std::max(fastest2, vx * vx + vy * vy + vz * vz);
    }
    return fastest2 > limit * limit;
  }

  void prepare(const State& now, const World& world, const StepContext& c, Buffers& buffers) const {
    if (noise_ == Noise::gaussian) buffers.gaussian.draw(c.rng, Stream::noise, c.tick, now.id);
    if (noise_ == Noise::gaussian && continuous_) buffers.area.draw(c.rng, Stream::noise_path, c.tick, now.id);
    if (noise_ == Noise::ou) prepare_memory(now, c, buffers);
    if (interaction_) {
      const double reach = c.p[kRRep] + c.p[kRAli] + c.p[kRAtt];
      c.near.build(now.pos, world.bounds, reach);
    }
    if (!avoidance_) return;
    const double range = c.p[kNeighbourDistance] > 0 ? c.p[kNeighbourDistance] : 10 * c.p[kRadius];
    buffers.avoider.begin(now, world.bounds, {c.p[kRadius], c.p[kMaxSpeed], c.p[kTimeHorizon], range, c.p[kMaxNeighbours]});
  }

  Array3d preferred(const Array3d& v, const Array3d& force, const StepContext& c) const {
    const double drag = c.p[kGamma] * std::sqrt(v.square().sum());
    if (implicit_drag_) return (v + force * c.dt) / (1 + drag * c.dt);
    return v + (force - drag * v) * c.dt;
  }

  Array3d flat(const Array3d& f) const { return dims_ == 2 ? Array3d(f[0], f[1], 0) : f; }

  // ---- Eq 4 ---------------------------------------------------------------------------------------------------------------------

  Array3d noise(const State& now, Index i, const StepContext& c) const {
    const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
    switch (noise_) {
      case Noise::none:
        return Array3d::Zero();
      case Noise::white:
        return flat(of_white(c) * white_noise(c.rng, c.tick, id));
      case Noise::gaussian:
        return flat(amplitude(c) * static_cast<const Buffers*>(c.work)->gaussian[i]);
      case Noise::ou:
        return added_by_memory(now, i, c, 1) / c.dt;
      case Noise::curl:
      case Noise::perlin:
        break;
    }
    const NoiseField& field = *static_cast<const Buffers*>(c.work)->field;
    Array3d x = now.pos.row(i).transpose() / c.p[kScale];
    if (per_agent_offset_) x += offset_of(c.rng, id);
    if (noise_ == Noise::perlin) return flat(c.p[kNoise] / kRmsPotential * field.potential(x));
    return c.p[kNoise] / rms_curl(dims_) * (dims_ == 2 ? field.curl2(x) : field.curl(x));
  }

  // Continuous noise changes the velocity gradually, so the path falls behind v dt by half of what the kick alone adds to it, and scatters
  // by the area of a Brownian bridge.
  Array3d astray(const State& now, Index i, const StepContext& c) const {
    constexpr double bridge = 0.28867513459481287;  // 1 / sqrt(12)
    const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
    if (noise_ == Noise::gaussian) {
      const Buffers& buffers = *static_cast<const Buffers*>(c.work);
      return flat(amplitude(c) * c.dt * c.dt * (bridge * buffers.area[i] - 0.5 * buffers.gaussian[i]));
    }
    return flat(of_white(c) * c.dt * c.dt *
                (bridge * white_noise(c.rng, c.tick, id, Stream::noise_path) - 0.5 * white_noise(c.rng, c.tick, id)));
  }

  double amplitude(const StepContext& c) const { return sde_ ? c.p[kLambda] / std::sqrt(c.dt) : c.p[kLambdaLiteral]; }

  // Uniform on [-1, 1), W has the variance 1/3; printed literally it keeps it.
  double of_white(const StepContext& c) const { return sde_ ? std::numbers::sqrt3 * amplitude(c) : amplitude(c); }

  static void prepare_memory(const State& now, const StepContext& c, Buffers& buffers) {
    if (const std::array now_of{c.dt, c.p[kTau], c.p[kNoise]}; buffers.of != now_of) {
      buffers.of = now_of;
      const LinearNoise<3>::Matrix drift{{{0, 1, 0}, {0, 0, 1}, {0, 0, -1 / c.p[kTau]}}};
      buffers.memory = LinearNoise<3>(drift, {0, 0, c.p[kNoise] * std::sqrt(2 / c.p[kTau])}, c.dt);
    }
    buffers.gaussian.draw(c.rng, Stream::noise, c.tick, now.id);
    buffers.area.draw(c.rng, Stream::noise_path, c.tick, now.id);
    buffers.third.draw(c.rng, Stream::noise_path_2, c.tick, now.id);
  }

  // What the force of memory adds to the place (0) or the velocity (1) by the end of the step, or what it is then (2): exact.
  Array3d added_by_memory(const State& now, Index i, const StepContext& c, std::size_t row) const {
    const Buffers& buffers = *static_cast<const Buffers*>(c.work);
    const auto& draw = buffers.memory.draw[row];
    const Array3d eta = now.own.row(i).segment(kEta, 3).transpose();
    const Array3d drawn = draw[0] * buffers.gaussian[i] + draw[1] * buffers.area[i] + draw[2] * buffers.third[i];
    return buffers.memory.keep[row][2] * eta + flat(drawn);
  }

  // Where it takes an agent within the step, beside what the new velocity does.
  Array3d remembered(const State& now, State& next, Index i, const StepContext& c) const {
    next.own.row(i).segment(kEta, 3) = added_by_memory(now, i, c, 2).transpose();
    return added_by_memory(now, i, c, 0) - c.dt * added_by_memory(now, i, c, 1);
  }

  static Array3d offset_of(const Rng& rng, std::uint32_t id) {
    const auto xy = rng.uniform2(Stream::noise_table, 2, id, 0);
    return 256 * Array3d(xy[0], xy[1], rng.uniform(Stream::noise_table, 2, id, 1));
  }

  // ---- Eq 5 ---------------------------------------------------------------------------------------------------------------------

  Array3d interaction(const State& now, Index i, const StepContext& c) const {
    const double r_rep = c.p[kRRep], r_ali = r_rep + c.p[kRAli], r_att = r_ali + c.p[kRAtt];
    ZoneSums zones = zone_sums(c.near, i, r_rep, r_ali, r_att);
    if (zones.coincident > 0) add_coincident(zones, now, i, c);
    Array3d force = Array3d::Zero();
    if (zones.near_count > 0) force -= c.p[kChiRep] / zones.near_count * zones.near;
    if (zones.far_count > 0) force += c.p[kChiAtt] / zones.far_count * zones.far;
    if (c.p[kChiAli] > 0 && c.p[kRAli] > 0) force += c.p[kChiAli] * alignment(now, i, c);
    return force;
  }

  // Agents at the same place have no direction from one to the other: one is drawn.
  void add_coincident(ZoneSums& zones, const State& now, Index i, const StepContext& c) const {
    const bool repelled = c.p[kRRep] > 0;
    if (!repelled && c.p[kRAli] > 0) return;  // they are in the shell of alignment
    for (Index k = 0; k < zones.coincident; ++k) {
      const auto draw = static_cast<std::uint32_t>(k);
      const Array3d direction = random_direction(c.rng, Stream::tie_break, c.tick, now.id[static_cast<std::size_t>(i)], draw, dims_);
      (repelled ? zones.near : zones.far) += direction;
      (repelled ? zones.near_count : zones.far_count) += 1;
    }
  }

  // Mean unit vector of the relative velocities in the shell of alignment.
  Array3d alignment(const State& now, Index i, const StepContext& c) const {
    const double from = c.p[kRRep], to = from + c.p[kRAli];
    const double softness = soft_alignment_ ? c.p[kChiAli] * c.dt : 0;
    Array3d sum = Array3d::Zero();
    int count = 0;
    c.near.visit(i, [&](Index j, const Array3d&, double r) {
      if (r < from || r >= to) return;
      ++count;
      const Array3d dv = (now.vel.row(j) - now.vel.row(i)).transpose();
      const double speed = std::sqrt(dv.square().sum());
      if (speed >= 1e-9) sum += dv / std::max(speed, softness);
    });
    return count > 0 ? Array3d(sum / count) : sum;
  }

  // ---- F_res --------------------------------------------------------------------------------------------------------------------

  Array3d response(const State& now, State& next, Index i, const Stimuli& stimuli, const Bounds& bounds, const StepContext& c) const {
    const auto near = stimuli.nearest(now.pos.row(i).transpose(), bounds, c.p[kRRes]);
    double theta = now.own(i, kTheta);
    if (near.index >= 0 && now.own(i, kStimulus) != near.index + 1) theta = draw_theta(c, now.id[static_cast<std::size_t>(i)]);
    next.own(i, kStimulus) = near.index + 1;
    next.own(i, kTheta) = theta;
    if (near.index < 0) return Array3d::Zero();
    return c.p[kChiRes] * (near.kind == Stimulus::Kind::attract ? Array3d(-near.from) : turned(near.from, theta));
  }

  double draw_theta(const StepContext& c, std::uint32_t id) const {
    const auto u = c.rng.uniform2(Stream::response, c.tick, id);
    const double theta = -u[0] * std::numbers::pi / 2;
    return both_sides_ && u[1] < 0.5 ? -theta : theta;
  }

  // Turned by theta about y, the vertical; motion in the plane turns about z.
  Array3d turned(const Array3d& a, double theta) const {
    const double cosine = std::cos(theta), sine = std::sin(theta);
    if (dims_ == 2) return {cosine * a[0] - sine * a[1], sine * a[0] + cosine * a[1], 0};
    return {cosine * a[0] + sine * a[2], a[1], -sine * a[0] + cosine * a[2]};
  }

  int dims_;
  Noise noise_;
  Infeasible infeasible_;
  bool interaction_, avoidance_, implicit_drag_, sde_, continuous_, soft_alignment_, per_agent_offset_, both_sides_;
};

}  // namespace

ModelSpec bswarm_spec() {
  return {.name = "bswarm",
          .summary = "insect swarm: repulsion, alignment, attraction, quadratic drag and noise, with collision avoidance",
          .citation = "Ren et al. 2016, doi:10.1371/journal.pone.0155698",
          .dims = {2, 3},
          .native_dt = 0.01,
          .map = "noise=white|gaussian,noise_scaling=literal",
          .largest_dt = 1.0 / 40,  // gamma |v| dt = 0.5 at the upper bound of gamma and the recorded speed
          .quiet = "noise=none",
          .options = option_table(),
          .columns = {"stimulus", "theta", "eta_x", "eta_y", "eta_z"},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Bswarm>(setup); },
          .force = ForceLike{.when = "noise=white|gaussian|ou|none",  // a field is a force of the place itself
                             .options = {{"noise", "none"}, {"avoidance", "none"}},
                             .jumps = {kRRep, kRAtt, kRAli},
                             .memory = "noise=ou"}};
}

}  // namespace swarmfit
