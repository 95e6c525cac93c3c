// SPDX-License-Identifier: MIT
#include "libtrack/normals.h"

#include <algorithm>

#include "libtrack/hot.h"

#ifdef SWARMFIT_TWO_VERSIONS
#include <immintrin.h>
#endif

namespace swarmfit {
namespace {

using Word4 = std::uint64_t __attribute__((vector_size(32)));

constexpr double kRound = 0x1.8p52;  // adding it leaves the nearest integer in the lowest bits

// Two numbers on [0, 1) for each of two draws and four ids.
struct Uniforms {
  double radius[2][4], angle[2][4];
};

inline __attribute__((always_inline)) void root(const Lanes& a, Lanes& out) {
  for (int l = 0; l < 4; ++l) out[l] = std::sqrt(a[l]);
}

// log(x) of normal numbers in (0, 1]: 2 artanh(s) of the significand in [sqrt(1/2), sqrt(2)), s = (m - 1) / (m + 1), and the exponent.
inline __attribute__((always_inline)) void logarithm(const Lanes& x, Lanes& out) {
  constexpr double high = 0x1.62e42feep-1, low = 1.90821492927058770002e-10;  // log(2) = high + low
  const auto bits = __builtin_bit_cast(Word4, x);
  const Word4 offset = bits - 0x3fe6a09e667f3bcdULL;  // of sqrt(1/2)
  // The exponent's 12 signed bits, biased to be positive, as a double: planted into the significand of 2^52.
  const Word4 biased = ((offset >> 52) + 2048) & 4095;
  const Lanes exponent = __builtin_bit_cast(Lanes, biased | 0x4330000000000000ULL) - (0x1p52 + 2048);
  const Lanes m = __builtin_bit_cast(Lanes, bits - (offset & 0xfff0000000000000ULL));
  const Lanes s = (m - 1) / (m + 1), s2 = s * s, s4 = s2 * s2;  // |s| < 0.1716: the series is cut where it errs by 1e-17
  const Lanes a = (2.0 / 3 + s2 * (2.0 / 5)) + s4 * (2.0 / 7 + s2 * (2.0 / 9));
  const Lanes b = (2.0 / 11 + s2 * (2.0 / 13)) + s4 * (2.0 / 15 + s2 * (2.0 / 17));
  const Lanes tail = s * s2 * (a + s4 * s4 * (b + s4 * s4 * (2.0 / 19)));
  out = exponent * high + (2 * s + (tail + exponent * low));
}

// Sine and cosine of 2 pi u, u on [0, 1): Taylor's series within an eighth of a turn of a quarter.
inline __attribute__((always_inline)) void turn(const Lanes& u, Lanes& sine, Lanes& cosine) {
  const Lanes quarters = 4 * u, shifted = quarters + kRound;
  const Lanes x = (quarters - (shifted - kRound)) * 1.5707963267948966, x2 = x * x, x4 = x2 * x2;  // exact but for the product
  const Lanes sa = (-1.0 / 6 + x2 * (1.0 / 120)) + x4 * (-1.0 / 5040 + x2 * (1.0 / 362880));
  const Lanes sb = (-1.0 / 39916800 + x2 * (1.0 / 6227020800)) + x4 * (-1.0 / 1307674368000);
  const Lanes s = x + x * x2 * (sa + x4 * x4 * sb);
  const Lanes ca = (1.0 / 24 + x2 * (-1.0 / 720)) + x4 * (1.0 / 40320 + x2 * (-1.0 / 3628800));
  const Lanes cb = (1.0 / 479001600 + x2 * (-1.0 / 87178291200)) + x4 * (1.0 / 20922789888000);
  const Lanes c = 1 - (0.5 * x2 - x4 * (ca + x4 * x4 * cb));
  const auto quarter = __builtin_bit_cast(Word4, shifted);
  const auto odd = (quarter & 1) != 0;
  const auto sine_down = (quarter & 2) << 62, cosine_down = ((quarter + 1) & 2) << 62;  // the sign bit
  sine = __builtin_bit_cast(Lanes, __builtin_bit_cast(Word4, odd ? c : s) ^ sine_down);
  cosine = __builtin_bit_cast(Lanes, __builtin_bit_cast(Word4, odd ? s : c) ^ cosine_down);
}

struct Twelve {
  double x[4], y[4], z[4];
};

inline __attribute__((always_inline)) void box_muller(const Uniforms& u, Twelve& out) {
  Lanes first, second, r0, r1, s0, c0, s1, c1;
  load(u.radius[0], first), load(u.radius[1], second);
  logarithm(1 - first, r0), logarithm(1 - second, r1);
  root(-2 * r0, r0), root(-2 * r1, r1);
  load(u.angle[0], first), load(u.angle[1], second);
  turn(first, s0, c0), turn(second, s1, c1);
  const Lanes x = r0 * c0, y = r0 * s0, z = r1 * c1;
  std::memcpy(out.x, &x, sizeof x);
  std::memcpy(out.y, &y, sizeof y);
  std::memcpy(out.z, &z, sizeof z);
}

// The twelve of four ids; start: their counter without id and draw.
#ifdef SWARMFIT_TWO_VERSIONS
__attribute__((target("default")))
#endif
void twelve(const std::uint32_t* ids, philox::Counter start, philox::Key key, Twelve& out) {
  Uniforms u;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::uint32_t draw = 0; draw < 2; ++draw) {
      const auto b = philox::bijection({draw, ids[k], start[2], start[3]}, key);
      u.radius[draw][k] = Rng::to_unit(b[0], b[1]), u.angle[draw][k] = Rng::to_unit(b[2], b[3]);
    }
  box_muller(u, out);
}

#ifdef SWARMFIT_TWO_VERSIONS
// The same bits, with the eight counters in the lanes of four words: draw 0 of the ids, then draw 1.
struct HighAndLow {
  __m256i high, low;
};

// The 64-bit products of eight 32-bit numbers and another. Compilers get there by shuffles that cost more than they save.
__attribute__((target("avx2"), always_inline)) inline void multiply(__m256i x, __m256i by, HighAndLow& out) {
  const __m256i even = _mm256_mul_epu32(x, by), odd = _mm256_mul_epu32(_mm256_srli_epi64(x, 32), by);
  out.high = _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xAA);
  out.low = _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xAA);
}

__attribute__((target("avx2"), always_inline)) inline __m256i all(std::uint32_t x) { return _mm256_set1_epi32(static_cast<int>(x)); }

// Rng::to_unit of four: the 53 bits as two numbers of at most 32 bits, each planted into a significand; every step is exact.
__attribute__((target("avx2"), always_inline)) inline void to_unit(__m128i low, __m128i high, double* out) {
  const __m256i bits = _mm256_or_si256(_mm256_slli_epi64(_mm256_cvtepu32_epi64(high), 32), _mm256_cvtepu32_epi64(low));
  const __m256i word = _mm256_srli_epi64(bits, 11);
  const __m256d upper = _mm256_castsi256_pd(_mm256_or_si256(_mm256_srli_epi64(word, 32), _mm256_castpd_si256(_mm256_set1_pd(0x1p84))));
  const __m256d lower = _mm256_castsi256_pd(_mm256_blend_epi32(word, _mm256_castpd_si256(_mm256_set1_pd(0x1p52)), 0xAA));
  const __m256d value = _mm256_add_pd(_mm256_sub_pd(upper, _mm256_set1_pd(0x1p84 + 0x1p52)), lower);
  _mm256_storeu_pd(out, _mm256_mul_pd(value, _mm256_set1_pd(0x1p-53)));
}

__attribute__((target("avx2"))) void twelve(const std::uint32_t* ids, philox::Counter start, philox::Key key, Twelve& out) {
  __m128i four;
  std::memcpy(&four, ids, sizeof four);
  __m256i word[4] = {_mm256_set_epi32(1, 1, 1, 1, 0, 0, 0, 0), _mm256_set_m128i(four, four), all(start[2]), all(start[3])};
  const __m256i by0 = all(philox::kMultiplier0), by1 = all(philox::kMultiplier1);
  for (int round = 0; round < 10; ++round) {
    HighAndLow a, b;
    multiply(word[0], by0, a), multiply(word[2], by1, b);
    word[0] = _mm256_xor_si256(_mm256_xor_si256(b.high, word[1]), all(key[0]));
    word[2] = _mm256_xor_si256(_mm256_xor_si256(a.high, word[3]), all(key[1]));
    word[1] = b.low;
    word[3] = a.low;
    key[0] += philox::kWeyl0;
    key[1] += philox::kWeyl1;
  }
  Uniforms u;
  to_unit(_mm256_castsi256_si128(word[0]), _mm256_castsi256_si128(word[1]), u.radius[0]);
  to_unit(_mm256_castsi256_si128(word[2]), _mm256_castsi256_si128(word[3]), u.angle[0]);
  to_unit(_mm256_extracti128_si256(word[0], 1), _mm256_extracti128_si256(word[1], 1), u.radius[1]);
  to_unit(_mm256_extracti128_si256(word[2], 1), _mm256_extracti128_si256(word[3], 1), u.angle[1]);
  box_muller(u, out);
}
#endif

}  // namespace

void three_normals(const Rng& rng, Stream stream, std::uint64_t tick, std::span<const std::uint32_t> ids, double* x, double* y, double* z) {
  const philox::Counter start = Rng::counter(stream, tick, 0, 0);
  std::uint32_t last[4] = {};
  Twelve found;
  for (std::size_t first = 0; first < ids.size(); first += 4) {
    const std::size_t n = std::min<std::size_t>(4, ids.size() - first);
    if (n < 4) std::copy_n(ids.data() + first, n, last);
    twelve(n < 4 ? last : ids.data() + first, start, rng.key(), found);
    std::copy_n(found.x, n, x + first);
    std::copy_n(found.y, n, y + first);
    std::copy_n(found.z, n, z + first);
  }
}

Eigen::Array3d three_normals(const Rng& rng, Stream stream, std::uint64_t tick, std::uint32_t id) {
  Eigen::Array3d out;
  three_normals(rng, stream, tick, {&id, 1}, &out[0], &out[1], &out[2]);
  return out;
}

}  // namespace swarmfit
