// SPDX-License-Identifier: MIT
// Noise as a force: independent draws per agent and step (white, Gaussian), or a field fixed in space (Perlin, curl).
// K. Perlin, Improving noise, SIGGRAPH 2002 (doi:10.1145/566654.566636); R. Bridson et al., Curl-noise for procedural fluid flow,
// SIGGRAPH 2007 (doi:10.1145/1276377.1276435).
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "libtrack/rng.h"
#include "libtrack/tracks.h"

namespace swarmfit {

// Value and gradient of a scalar field.
struct Potential {
  double value;
  Eigen::Array3d gradient;
};

// Values and gradients of the components of a vector field.
struct VectorPotential {
  Eigen::Array3d value;
  Eigen::Array33d gradient;  // row k: the gradient of component k
};

// Improved Perlin noise: C2, period 256, zero at all lattice points, one lattice cell per unit of length.
// Root-mean-square value 0.27, root-mean-square gradient 1.23; the value stays within ±1.04.
class Perlin {
 public:
  using Permutation = std::array<std::uint8_t, 256>;
  explicit Perlin(const Permutation& permutation);

  // A table shuffled from Stream::noise_table; `index` tells the tables of one run apart.
  static Permutation shuffled(const Rng& rng, std::uint32_t index);

  Potential operator()(const Eigen::Array3d& x) const;

 private:
  friend class NoiseField;
  std::array<std::uint8_t, 512> hash_;  // the permutation twice, which saves wrapping the index
};

// Three independent Perlin potentials P = (P1, P2, P3), each with a random offset: without them all three vanish at the lattice points.
// x is in units of the feature size; for a field with `gain` and `scale`, P(r) = gain · potential(r / scale).
class NoiseField {
 public:
  explicit NoiseField(const Rng& rng);

  Eigen::Array3d potential(const Eigen::Array3d& x) const;

  // The same with its gradients, for whoever bends the potential before taking the curl.
  VectorPotential vector_potential(const Eigen::Array3d& x) const;

  // curl P = (∂P3/∂y - ∂P2/∂z, ∂P1/∂z - ∂P3/∂x, ∂P2/∂x - ∂P1/∂y): divergence-free; root-mean-square length 1.72.
  Eigen::Array3d curl(const Eigen::Array3d& x) const;

  // The two-dimensional variant (∂P1/∂y, -∂P1/∂x, 0).
  Eigen::Array3d curl2(const Eigen::Array3d& x) const;

 private:
  std::array<Perlin, 3> perlin_;
  std::array<Eigen::Array3d, 3> offset_;
  double lanes_[3][4]{};  // the same by axis, a potential per lane
};

// What potential() is multiplied by to have the root-mean-square length of curl() or curl2(): 1.72 and 1.00 over 0.27 sqrt(dims).
inline double potential_as_strong_as_curl(int dims) { return dims == 2 ? 2.62 : 3.68; }

// Three independent numbers, uniform on [-1, 1): variance 1/3 each.
Eigen::Array3d white_noise(const Rng& rng, std::uint64_t tick, std::uint32_t id, Stream stream = Stream::noise);

// Three independent standard normals for every agent.
class GaussianNoise {
 public:
  void draw(const Rng& rng, Stream stream, std::uint64_t tick, std::span<const std::uint32_t> id);
  Eigen::Array3d operator[](Index i) const { return values_.row(i).transpose(); }

 private:
  Rows values_;
};

// The same for one, from Stream::noise.
Eigen::Array3d gaussian_noise(const Rng& rng, std::uint64_t tick, std::uint32_t id);

// A direction, uniform on the sphere, or on the circle in two dimensions.
Eigen::Array3d random_direction(const Rng& rng, Stream stream, std::uint64_t tick, std::uint32_t id, std::uint32_t draw, int dims);

// The direction in which agent `self` leaves `other` when both are at the same place: opposite for the two, new every tick.
Eigen::Array3d parting_direction(const Rng& rng, std::uint64_t tick, std::uint32_t self, std::uint32_t other, int dims);

}  // namespace swarmfit
