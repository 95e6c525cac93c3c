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
//            repulsion   g = -1   0                  <= r <  r_rep
//            alignment   g =  0   r_rep              <= r <  r_rep + r_ali*
//            attraction  g = +1   r_rep + r_ali*     <= r <= r_rep + r_ali* + r_att*
//   F_fric = -gamma |v| v
//   F_noise: option `noise`, below
//   v_pref = v + F dt;  v = collision-free velocity nearest to v_pref;  r = r + v dt       (Algorithm 1; synchronous, semi-implicit Euler)
//
// Radii are stored as the widths of the zones' shells (starred), so that r_att >= r_ali >= r_rep >= 0 holds by construction.
//
//   noise     curl      noise · curl P(r / scale), a field fixed in space: agents at one place feel the same force; noise = gain / scale
//             perlin    noise · P(r / scale); noise = gain
//             white     lambda · W, W uniform on [-1, 1) per component, new for each agent and step
//             gaussian  lambda · G, G standard normal
//             none      0
//   noise_scaling  sde: white and Gaussian forces are divided by sqrt(dt), so that diffusion does not depend on dt; literal: as printed
//   interaction    off: F_int = 0 (the paper's "noise only")
//   drag           implicit: v_pref = (v + F' dt) / (1 + gamma |v| dt), stable for any step
//   align          soft: vhat shrinks with the difference of velocities once that is below chi_ali dt, which stops chatter
//   offset         per_agent: every agent has a noise field of its own
#include <algorithm>
#include <cmath>

#include "libswarm/model.h"
#include "libswarm/noise.h"
#include "libswarm/parallel.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

// Rows of the parameter table, in its order.
enum Row : std::size_t { kGamma, kNoise, kScale, kLambda, kLambdaLiteral, kChiRep, kChiAtt, kRRep, kRAtt, kChiAli, kRAli };

enum class Noise { curl, perlin, gaussian, white, none };

const std::vector<Option>& option_table() {
  static const std::vector<Option> table{
      {"noise", {"curl", "perlin", "gaussian", "white", "none"}, "random force"},
      {"interaction", {"on", "off"}, "repulsion, alignment and attraction between agents"},
      {"drag", {"explicit", "implicit"}, "how the quadratic drag is stepped"},
      {"noise_scaling", {"sde", "literal"}, "white and Gaussian noise: independent of the time step, or as printed"},
      {"align", {"literal", "soft"}, "alignment force: constant magnitude, or fading with the difference of velocities"},
      {"offset", {"shared", "per_agent"}, "one noise field for all, or one for each agent"},
  };
  return table;
}

const std::vector<Parameter>& parameter_table() {
  using enum Parameter::Length;
  static const std::vector<Parameter> table{
      {"gamma", "γ", {-1, 0}, {11.16, 0.1, 20}, {1.5, 0.1, 20}, extent, true, true, "", "quadratic drag", "Eq 3; Table 1 Midge"},
      {"noise",
       "gain/scale",
       {1, -2},
       {2.51 / 2.20, 0, 40},
       {2, 0, 20},
       extent,
       false,
       true,
       "noise=curl|perlin",
       "strength of the noise force (gain for Perlin noise)",
       "Eq 4; Table 1 Midge"},
      {"scale",
       "scale",
       {1, 0},
       {2.20, 0.2, 5},
       {0.5, 0.1, 3},
       extent,
       true,
       true,
       "noise=curl|perlin",
       "feature size of the noise field",
       "Eq 4; Table 1 Midge"},
      {"lambda",
       "λ",
       {1, -1.5},
       {1, 0, 20},
       {1, 0, 3},
       extent,
       false,
       true,
       "noise=white|gaussian,noise_scaling=sde",
       "intensity of the random force, per square root of time",
       "Eq 4"},
      {"lambda_literal",
       "λ",
       {1, -2},
       {1, 0, 20},
       {5, 0, 20},
       extent,
       false,
       true,
       "noise=white|gaussian,noise_scaling=literal",
       "amplitude of the random force, redrawn each step",
       "Eq 4"},
      {"chi_rep", "χ_rep", {1, -2}, {5.61, 0, 30}, {5, 0, 20}, extent, false, true, "interaction=on", "repulsion", "Eq 5; Table 1 Midge"},
      {"chi_att", "χ_att", {1, -2}, {14.29, 0, 40}, {5, 0, 20}, extent, false, true, "interaction=on", "attraction", "Eq 5; Table 1 Midge"},
      {"r_rep",
       "r_rep",
       {1, 0},
       {0.17, 0, 8},
       {0.5, 0, 3},
       spacing,
       false,
       true,
       "interaction=on",
       "radius of repulsion",
       "Eq 5; Table 1 Midge"},
      {"r_att",
       "r_att*",
       {1, 0},
       {5.12, 0, 20},
       {5, 0, 10},
       spacing,
       false,
       true,
       "interaction=on",
       "width of the shell of attraction",
       "Eq 5; Table 1 Midge"},
      {"chi_ali", "χ_ali", {1, -2}, {0, 0, 20}, {0, 0, 20}, extent, false, false, "interaction=on", "alignment", "Eq 5; Table 1 Midge"},
      {"r_ali",
       "r_ali*",
       {1, 0},
       {0, 0, 12},
       {0, 0, 5},
       spacing,
       false,
       false,
       "interaction=on",
       "width of the shell of alignment",
       "Eq 5; Table 1 Midge"},
  };
  return table;
}

struct NoiseWorkspace : Workspace {
  explicit NoiseWorkspace(const Rng& rng) : field(rng) {}
  NoiseField field;
};

class Bswarm : public Model {
 public:
  explicit Bswarm(const Setup& setup)
      : dims_(setup.dims),
        noise_(parse_noise(setup.options.at("noise"))),
        interaction_(setup.options.at("interaction") == "on"),
        implicit_drag_(setup.options.at("drag") == "implicit"),
        sde_(setup.options.at("noise_scaling") == "sde"),
        soft_alignment_(setup.options.at("align") == "soft"),
        per_agent_offset_(setup.options.at("offset") == "per_agent") {}

  std::unique_ptr<Workspace> workspace(const World&, const Rng& rng) const override { return std::make_unique<NoiseWorkspace>(rng); }

  Step step(const State& now, State& next, const World& world, const StepContext& c) const override {
    if (!implicit_drag_ && c.can_halve && too_fast(now, c)) return Step::halve_dt;
    if (interaction_) c.near.build(now.pos, world.bounds, reach(c));
    for_each_agent(now.size(), [&](Index i) {
      const Array3d v = now.vel.row(i).transpose();
      Array3d force = noise(now, i, c);
      if (interaction_) force += interaction(now, i, c);
      const double drag = c.p[kGamma] * std::sqrt(v.square().sum());
      const Array3d preferred = implicit_drag_ ? Array3d((v + force * c.dt) / (1 + drag * c.dt)) : Array3d(v + (force - drag * v) * c.dt);
      next.vel.row(i) = preferred.transpose();
      next.pos.row(i) = now.pos.row(i) + preferred.transpose() * c.dt;
    });
    return Step::done;
  }

 private:
  static Noise parse_noise(std::string_view name) {
    if (name == "curl") return Noise::curl;
    if (name == "perlin") return Noise::perlin;
    if (name == "gaussian") return Noise::gaussian;
    return name == "white" ? Noise::white : Noise::none;
  }

  static double reach(const StepContext& c) {
    const double r = c.p[kRRep] + c.p[kRAli] + c.p[kRAtt];
    return std::nextafter(r, 2 * r + 1);  // r <= r_att is inside, by Eq 5
  }

  // The explicit drag step reverses the motion of anybody with gamma |v| dt > 1.
  static bool too_fast(const State& now, const StepContext& c) {
    const double limit = 1 / (c.p[kGamma] * c.dt);
    return (now.vel.square().rowwise().sum() > limit * limit).any();
  }

  Array3d flat(const Array3d& f) const { return dims_ == 2 ? Array3d(f[0], f[1], 0) : f; }

  Array3d noise(const State& now, Index i, const StepContext& c) const {
    const std::uint32_t id = now.id[static_cast<std::size_t>(i)];
    switch (noise_) {
      case Noise::none:
        return Array3d::Zero();
      case Noise::white:
        return flat(amplitude(c) * white_noise(c.rng, c.tick, id));
      case Noise::gaussian:
        return flat(amplitude(c) * gaussian_noise(c.rng, c.tick, id));
      case Noise::curl:
      case Noise::perlin:
        break;
    }
    const NoiseField& field = static_cast<const NoiseWorkspace*>(c.work)->field;
    Array3d x = now.pos.row(i).transpose() / c.p[kScale];
    if (per_agent_offset_) x += offset_of(c.rng, id);
    if (noise_ == Noise::perlin) return flat(c.p[kNoise] * field.potential(x));
    return c.p[kNoise] * (dims_ == 2 ? field.curl2(x) : field.curl(x));
  }

  double amplitude(const StepContext& c) const { return sde_ ? c.p[kLambda] / std::sqrt(c.dt) : c.p[kLambdaLiteral]; }

  static Array3d offset_of(const Rng& rng, std::uint32_t id) {
    const auto xy = rng.uniform2(Stream::noise_table, 2, id, 0);
    return 256 * Array3d(xy[0], xy[1], rng.uniform(Stream::noise_table, 2, id, 1));
  }

  // Eq 5.
  Array3d interaction(const State& now, Index i, const StepContext& c) const {
    const double r_rep = c.p[kRRep], r_ali = r_rep + c.p[kRAli];
    Array3d away = Array3d::Zero(), along = Array3d::Zero(), toward = Array3d::Zero();
    int n_rep = 0, n_ali = 0, n_att = 0;
    c.near.visit(i, [&](Index j, const Array3d& offset, double r) {
      const Array3d direction = r < 1e-9 ? tie_break(now, i, c) : Array3d(offset / r);
      if (r < r_rep) {
        away -= direction;
        ++n_rep;
      } else if (r < r_ali) {
        along += aligned(now.vel.row(j).transpose() - now.vel.row(i).transpose(), c);
        ++n_ali;
      } else {
        toward += direction;
        ++n_att;
      }
    });
    const auto mean = [](double chi, int n, const Array3d& sum) { return n > 0 ? Array3d(chi / n * sum) : Array3d(Array3d::Zero()); };
    return mean(c.p[kChiRep], n_rep, away) + mean(c.p[kChiAli], n_ali, along) + mean(c.p[kChiAtt], n_att, toward);
  }

  Array3d tie_break(const State& now, Index i, const StepContext& c) const {
    return random_direction(c.rng, Stream::tie_break, c.tick, now.id[static_cast<std::size_t>(i)], 0, dims_);
  }

  Array3d aligned(const Array3d& dv, const StepContext& c) const {
    const double speed = std::sqrt(dv.square().sum());
    if (speed < 1e-9) return Array3d::Zero();
    return dv / (soft_alignment_ ? std::max(speed, c.p[kChiAli] * c.dt) : speed);
  }

  int dims_;
  Noise noise_;
  bool interaction_, implicit_drag_, sde_, soft_alignment_, per_agent_offset_;
};

}  // namespace

ModelSpec bswarm_spec() {
  return {.name = "bswarm",
          .summary = "insect swarm: repulsion, alignment, attraction, quadratic drag and noise, with collision avoidance",
          .citation = "Ren et al. 2016, doi:10.1371/journal.pone.0155698",
          .dims = {2, 3},
          .native_dt = 0.01,
          .largest_dt = 1.0 / 40,  // gamma |v| dt = 0.5 at the upper bound of gamma and the recorded speed
          .options = option_table(),
          .columns = {},
          .parameters = parameter_table(),
          .make = [](const Setup& setup) -> std::unique_ptr<Model> { return std::make_unique<Bswarm>(setup); }};
}

}  // namespace swarmfit
