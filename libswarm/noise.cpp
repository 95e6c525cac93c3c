// SPDX-License-Identifier: MIT
#include "libswarm/noise.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "libswarm/parallel.h"
#include "libtrack/hot.h"
#include "libtrack/normals.h"

namespace swarmfit {
namespace {

// Perlin's 16 gradient directions: the 12 edges of a cube, four of them twice.
constexpr double kGradient[16][3] = {{1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
                                     {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {0, -1, 1}, {-1, 1, 0}, {0, -1, -1}};

// Position along one axis: lattice cell, fraction within it, fade weight 6t⁵ - 15t⁴ + 10t³ and its derivative.
struct Along {
  unsigned cell;
  double t, fade, slope;

  explicit Along(double x) {
    const double floor = std::floor(x);
    cell = static_cast<unsigned>(static_cast<std::int64_t>(floor)) & 255u;
    t = x - floor;
    fade = t * t * t * (t * (t * 6 - 15) + 10);
    slope = 30 * t * t * (t - 1) * (t - 1);
  }
};

// A corner's linear ramp g·(f - corner), and what becomes of several under trilinear blending.
using Ramp = std::array<double, 4>;  // value, gradient

Ramp mix(const Ramp& a, const Ramp& b, double w) {
  return {a[0] + w * (b[0] - a[0]), a[1] + w * (b[1] - a[1]), a[2] + w * (b[2] - a[2]), a[3] + w * (b[3] - a[3])};
}

// Blends two ramps along `axis`; the weight's own derivative adds slope · (b - a) there (product rule).
Ramp blend(const Ramp& a, const Ramp& b, const Along& along, std::size_t axis) {
  Ramp r = mix(a, b, along.fade);
  r[1 + axis] += along.slope * (b[0] - a[0]);
  return r;
}

// ---- several potentials at once, one per lane; operation by operation what Perlin does ----------------------------------------------

struct Along4 {
  std::int32_t cell[4];
  Lanes t, fade, slope;
};

inline __attribute__((always_inline)) void floor_of(const Lanes& x, Lanes& out) {
  for (int l = 0; l < 4; ++l) out[l] = std::floor(x[l]);
}

inline __attribute__((always_inline)) void along(const Lanes& x, Along4& a) {
  using Four = std::int32_t __attribute__((vector_size(16)));
  Lanes floor, period;
  floor_of(x, floor);
  floor_of(floor / 256, period);
  const Four cell = __builtin_convertvector(floor - 256 * period, Four) & 255;  // masked for what is not finite
  std::memcpy(a.cell, &cell, sizeof cell);
  const Lanes t = x - floor;
  a.t = t;
  a.fade = t * t * t * (t * (t * 6 - 15) + 10);
  a.slope = 30 * t * t * (t - 1) * (t - 1);
}

struct Ramps {
  Lanes value, x, y, z;
};

inline __attribute__((always_inline)) Ramps mixed(const Ramps& a, const Ramps& b, const Lanes& w) {
  return {a.value + w * (b.value - a.value), a.x + w * (b.x - a.x), a.y + w * (b.y - a.y), a.z + w * (b.z - a.z)};
}

// kGradient by component, a byte for each: the top byte of the double 2, -2 or 0. The bytes of all corners and potentials are found in two
// look-ups within a register, and a shift turns each into a number.
using Bytes = std::uint8_t __attribute__((vector_size(16)));
using Words = std::uint32_t __attribute__((vector_size(16)));
constexpr std::uint8_t kPlus = 0x40, kMinus = 0xC0;
constexpr double kUnit = 0.5;  // exact: results are as if the components were 1 and -1
constexpr Bytes kComponent[3] = {{kPlus, kMinus, kPlus, kMinus, kPlus, kMinus, kPlus, kMinus, 0, 0, 0, 0, kPlus, 0, kMinus, 0},
                                 {kPlus, kPlus, kMinus, kMinus, 0, 0, 0, 0, kPlus, kMinus, kPlus, kMinus, kPlus, kMinus, kPlus, kMinus},
                                 {0, 0, 0, 0, kPlus, kPlus, kMinus, kMinus, kPlus, kPlus, kMinus, kMinus, 0, kPlus, 0, kMinus}};

// The table's entries at the lower halves of `where`.
inline __attribute__((always_inline)) void look_up(const Bytes& table, const Words& where, std::uint32_t* out) {
#ifdef __clang__
  const auto which = __builtin_bit_cast(Bytes, where);
  Bytes found;
  for (int k = 0; k < 16; ++k) found[k] = table[which[k] & 15];
#else
  const Bytes found = __builtin_shuffle(table, __builtin_bit_cast(Bytes, where));
#endif
  std::memcpy(out, &found, sizeof found);
}

// Lane l: the number whose top byte is byte l.
inline __attribute__((always_inline)) void widen(std::uint32_t bytes, Lanes& out) {
  using Pairs = std::uint32_t __attribute__((vector_size(32)));
  using Quads = std::uint64_t __attribute__((vector_size(32)));
  const auto twice = __builtin_bit_cast(Quads, Pairs{} + bytes);
  out = __builtin_bit_cast(Lanes, (twice << Quads{24, 16, 8, 0}) & (Quads{} + (std::uint64_t{0xFF} << 56)));
}

// The three permutations, each twice, and where each potential is taken: x + offset; the fourth lane is not used.
using Hash = std::array<std::uint8_t, 512>;
struct Query {
  const Hash* hash[3];
  const double (*offset)[4];
  double x[3];
};

SWARMFIT_HOT void three_potentials(const Query& query, Ramps& out) {
  Along4 x, y, z;
  Lanes offset;
  load(query.offset[0], offset), along(query.x[0] + offset, x);
  load(query.offset[1], offset), along(query.x[1] + offset, y);
  load(query.offset[2], offset), along(query.x[2] + offset, z);
  unsigned h[8] = {};  // a byte per lane
  for (int l = 0; l < 3; ++l) {
    const std::uint8_t* hash = query.hash[l]->data();
    const int row[2] = {hash[x.cell[l]] + y.cell[l], hash[x.cell[l] + 1] + y.cell[l]};
    for (int c = 0; c < 8; ++c) h[c] |= unsigned{hash[hash[row[c & 1] + (c >> 1 & 1)] + z.cell[l] + (c >> 2)]} << 8 * l;
  }
  // All 32 components of one kind are two look-ups in a table that fits a register.
  std::uint32_t g[3][8];
  for (int half = 0; half < 8; half += 4) {
    const Words four{h[half], h[half + 1], h[half + 2], h[half + 3]};
    for (int axis = 0; axis < 3; ++axis) look_up(kComponent[axis], four, &g[axis][half]);
  }
  Ramps corner[8];
  for (unsigned c = 0; c < 8; ++c) {
    Lanes gx, gy, gz;
    widen(g[0][c], gx), widen(g[1][c], gy), widen(g[2][c], gz);
    corner[c] = {gx * (x.t - (c & 1)) + gy * (y.t - (c >> 1 & 1)) + gz * (z.t - (c >> 2)), gx, gy, gz};
  }
  Ramps edge[4], face[2];
  for (std::size_t k = 0; k < 4; ++k) {
    edge[k] = mixed(corner[2 * k], corner[2 * k + 1], x.fade);
    edge[k].x += x.slope * (corner[2 * k + 1].value - corner[2 * k].value);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    face[k] = mixed(edge[2 * k], edge[2 * k + 1], y.fade);
    face[k].y += y.slope * (edge[2 * k + 1].value - edge[2 * k].value);
  }
  out = mixed(face[0], face[1], z.fade);
  out.z += z.slope * (face[1].value - face[0].value);
  out = {kUnit * out.value, kUnit * out.x, kUnit * out.y, kUnit * out.z};
}

}  // namespace

Perlin::Perlin(const Permutation& permutation) {
  for (std::size_t i = 0; i < hash_.size(); ++i) hash_[i] = permutation[i & 255];
}

Perlin::Permutation Perlin::shuffled(const Rng& rng, std::uint32_t index) {
  Permutation p;
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = static_cast<std::uint8_t>(i);
  for (std::size_t i = p.size() - 1; i > 0; --i) {  // Fisher and Yates
    const double u = rng.uniform(Stream::noise_table, 0, index, static_cast<std::uint32_t>(i));
    std::swap(p[i], p[static_cast<std::size_t>(u * static_cast<double>(i + 1))]);
  }
  return p;
}

Potential Perlin::operator()(const Eigen::Array3d& position) const {
  const Along x(position[0]), y(position[1]), z(position[2]);
  const auto corner = [&](unsigned i, unsigned j, unsigned k) -> Ramp {
    const auto h = hash_[hash_[hash_[x.cell + i] + y.cell + j] + z.cell + k] & 15u;
    const double* g = kGradient[h];
    return {g[0] * (x.t - i) + g[1] * (y.t - j) + g[2] * (z.t - k), g[0], g[1], g[2]};
  };
  const auto edge = [&](unsigned j, unsigned k) { return blend(corner(0, j, k), corner(1, j, k), x, 0); };
  const auto face = [&](unsigned k) { return blend(edge(0, k), edge(1, k), y, 1); };
  const Ramp r = blend(face(0), face(1), z, 2);
  return {r[0], {r[1], r[2], r[3]}};
}

NoiseField::NoiseField(const Rng& rng)
    : perlin_{Perlin(Perlin::shuffled(rng, 0)), Perlin(Perlin::shuffled(rng, 1)), Perlin(Perlin::shuffled(rng, 2))} {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const auto xy = rng.uniform2(Stream::noise_table, 1, k, 0);
    const auto z = rng.uniform2(Stream::noise_table, 1, k, 1);
    offset_[k] = 256 * Eigen::Array3d(xy[0], xy[1], z[0]);
    for (Index axis = 0; axis < 3; ++axis) lanes_[axis][k] = offset_[k][axis];
  }
}

Eigen::Array3d NoiseField::potential(const Eigen::Array3d& x) const { return vector_potential(x).value; }

VectorPotential NoiseField::vector_potential(const Eigen::Array3d& x) const {
  const Query query{{&perlin_[0].hash_, &perlin_[1].hash_, &perlin_[2].hash_}, lanes_, {x[0], x[1], x[2]}};
  Ramps r;
  three_potentials(query, r);
  VectorPotential p;
  for (Index k = 0; k < 3; ++k) {
    p.value[k] = r.value[k];
    p.gradient.row(k) << r.x[k], r.y[k], r.z[k];
  }
  return p;
}

Eigen::Array3d NoiseField::curl(const Eigen::Array3d& x) const {
  const Eigen::Array33d g = vector_potential(x).gradient;
  return {g(2, 1) - g(1, 2), g(0, 2) - g(2, 0), g(1, 0) - g(0, 1)};
}

Eigen::Array3d NoiseField::curl2(const Eigen::Array3d& x) const {
  const Eigen::Array3d p = perlin_[0](x + offset_[0]).gradient;
  return {p[1], -p[0], 0};
}

Eigen::Array3d white_noise(const Rng& rng, std::uint64_t tick, std::uint32_t id, Stream stream) {
  const auto xy = rng.uniform2(stream, tick, id, 0);
  const double z = rng.uniform(stream, tick, id, 1);
  return {2 * xy[0] - 1, 2 * xy[1] - 1, 2 * z - 1};
}

Eigen::Array3d gaussian_noise(const Rng& rng, std::uint64_t tick, std::uint32_t id) { return three_normals(rng, Stream::noise, tick, id); }

void GaussianNoise::draw(const Rng& rng, Stream stream, std::uint64_t tick, std::span<const std::uint32_t> id) {
  const auto n = static_cast<Index>(id.size());
  values_.resize(n, 3);
  for_each_part(n, [&](Index first, Index count) {
    three_normals(rng, stream, tick, id.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)), &values_(first, 0),
                  &values_(first, 1), &values_(first, 2));
  });
}

Eigen::Array3d random_direction(const Rng& rng, Stream stream, std::uint64_t tick, std::uint32_t id, std::uint32_t draw, int dims) {
  const auto u = rng.uniform2(stream, tick, id, draw);
  const double angle = 2 * std::numbers::pi * u[0];
  const double z = dims == 2 ? 0 : 2 * u[1] - 1;  // Archimedes: uniform height is uniform on the sphere
  const double rho = std::sqrt(1 - z * z);
  return {rho * std::cos(angle), rho * std::sin(angle), z};
}

Eigen::Array3d parting_direction(const Rng& rng, std::uint64_t tick, std::uint32_t self, std::uint32_t other, int dims) {
  const Eigen::Array3d direction = random_direction(rng, Stream::tie_break, tick, std::min(self, other), std::max(self, other), dims);
  return self < other ? direction : Eigen::Array3d(-direction);
}

}  // namespace swarmfit
