// SPDX-License-Identifier: MIT
// A velocity of noise that is added to an agent's own: the baselines of X. Wang et al., Computer Graphics Forum 33(6), 2014
// (doi:10.1111/cgf.12277), section 7.1.
#pragma once

#include <string>

#include "libswarm/noise.h"

namespace swarmfit {

class Agitation {
 public:
  // perlin: proportional to Perlin noise of x / scale, the same for all. white: uniform on a cube, each agent's own at every draw.
  Agitation(const std::string& kind, int dims) : kind_(parsed(kind)), dims_(dims) {}

  explicit operator bool() const { return kind_ != Kind::none; }

  // Of root-mean-square length `strength`.
  Eigen::Array3d velocity(const NoiseField& field, const Eigen::Array3d& x, double strength, double scale, const Rng& rng,
                          std::uint64_t draw, std::uint32_t id) const {
    Eigen::Array3d v = Eigen::Array3d::Zero();
    const double root = dims_ == 2 ? 1.41421356 : 1.73205081;  // of as many equal components
    if (kind_ == Kind::perlin) v = strength / (kRmsPerlin * root) * field.potential(x / scale);
    if (kind_ == Kind::white) v = strength / (kRmsWhite * root) * white_noise(rng, draw, id);
    if (dims_ == 2) v[2] = 0;
    return v;
  }

 private:
  enum class Kind { none, perlin, white };
  static Kind parsed(const std::string& kind) { return kind == "perlin" ? Kind::perlin : kind == "white" ? Kind::white : Kind::none; }

  static constexpr double kRmsPerlin = 0.27;        // of a component of NoiseField::potential
  static constexpr double kRmsWhite = 0.577350269;  // of a number uniform on [-1, 1)

  Kind kind_;
  int dims_;
};

}  // namespace swarmfit
