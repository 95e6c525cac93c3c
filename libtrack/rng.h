// SPDX-License-Identifier: MIT
// Counter-based random numbers: every draw is a pure function of (seed, stream, tick, agent, draw), so results do not depend on the
// order of evaluation, the number of threads or an interruption. Philox 4x32-10 of Salmon et al., SC 2011 (doi:10.1145/2063384.2063405).
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace swarmfit {

// Every independent use of randomness has its own stream; the list stands here so that no two share one by accident.
// Never renumber: stored results depend on the numbers.
enum class Stream : std::uint32_t {
  noise = 1,          // inherent-noise force
  tie_break = 2,      // coincident agents
  noise_table = 3,    // permutation tables and offsets of gradient noise
  localisation = 4,   // camera error
  dropout = 5,        // missed detections
  start = 6,          // initial positions and headings
  replicate = 7,      // seeds of replicates
  search = 8,         // differential evolution
  final_seeds = 9,    // fresh seeds of the reported energies
  response = 10,      // turning angle towards or away from a stimulus
  probe = 11,         // random candidates of diagnostics
  selection = 12,     // seeds of the search about the leaders
  confirmation = 13,  // seeds on which the last few are compared
  goal = 14,          // places that agents head for
  hidden = 15,        // what an agent brings along and no recording shows, such as the state of its noise
  bootstrap = 16,     // recordings made by a fitted model
  posterior = 17,     // parameters drawn from a prior, and their recordings
  entry = 18,         // error of the velocities with which recorded agents enter
  surrogate = 20,     // recordings with a property destroyed
  noise_path = 21,    // what noise does to a path within a step, beside what it does to the velocity at its end
  noise_path_2 = 22,  // and a second number of that kind
  dither = 23,        // positions spread over the grid that a file is rounded to
  order = 24,         // who moves when, where agents move one after the other
  hold_out = 25       // seeds of the searches of halves of a recording
};

namespace philox {

using Counter = std::array<std::uint32_t, 4>;
using Key = std::array<std::uint32_t, 2>;

inline constexpr std::uint32_t kMultiplier0 = 0xD2511F53, kMultiplier1 = 0xCD9E8D57, kWeyl0 = 0x9E3779B9, kWeyl1 = 0xBB67AE85;

constexpr Counter bijection(Counter c, Key k) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = std::uint64_t{kMultiplier0} * c[0];
    const std::uint64_t b = std::uint64_t{kMultiplier1} * c[2];
    c = {static_cast<std::uint32_t>(b >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(a)};
    k[0] += kWeyl0;
    k[1] += kWeyl1;
  }
  return c;
}

}  // namespace philox

struct Rng {
  std::uint64_t seed = 0;

  static constexpr philox::Counter counter(Stream stream, std::uint64_t tick, std::uint32_t id, std::uint32_t draw) {
    return {draw, id, static_cast<std::uint32_t>(tick), static_cast<std::uint32_t>(tick >> 32) << 16 | static_cast<std::uint32_t>(stream)};
  }
  constexpr philox::Key key() const { return {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}; }

  // 128 random bits. tick < 2^48, stream < 2^16.
  philox::Counter bits(Stream stream, std::uint64_t tick, std::uint32_t id, std::uint32_t draw = 0) const {
    return philox::bijection(counter(stream, tick, id, draw), key());
  }

  // Two independent numbers, uniform on [0, 1) with 53 bits.
  std::array<double, 2> uniform2(Stream stream, std::uint64_t tick, std::uint32_t id, std::uint32_t draw = 0) const {
    const auto b = bits(stream, tick, id, draw);
    return {to_unit(b[0], b[1]), to_unit(b[2], b[3])};
  }

  double uniform(Stream stream, std::uint64_t tick, std::uint32_t id, std::uint32_t draw = 0) const {
    return uniform2(stream, tick, id, draw)[0];
  }

  // Two independent standard normals (Box and Muller 1958); 1 - u keeps the logarithm's argument in (0, 1].
  std::array<double, 2> normal2(Stream stream, std::uint64_t tick, std::uint32_t id, std::uint32_t draw = 0) const {
    const auto u = uniform2(stream, tick, id, draw);
    const double radius = std::sqrt(-2.0 * std::log(1.0 - u[0]));
    const double angle = 2.0 * std::numbers::pi * u[1];
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }

  // A seed of its own for part `index` of `stream`: replicates, models, refinements.
  Rng derive(Stream stream, std::uint64_t index, std::uint32_t id = 0) const {
    const auto b = bits(stream, index, id, 0xFFFFFFFFu);
    return {std::uint64_t{b[1]} << 32 | b[0]};
  }

  // 53 of 64 bits, on [0, 1).
  static double to_unit(std::uint32_t low, std::uint32_t high) {
    return static_cast<double>((std::uint64_t{high} << 32 | low) >> 11) * 0x1.0p-53;
  }
};

}  // namespace swarmfit
