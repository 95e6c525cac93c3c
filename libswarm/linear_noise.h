// SPDX-License-Identifier: MIT
// Exact steps of linear stochastic differential equations, of any length.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace swarmfit {

// dy = A y dt + b dW, W a Wiener process: y(t + dt) = keep · y(t) + draw · (standard normals), draw being lower triangular. (Gillespie,
// Phys. Rev. E 54: 2084, 1996, gives one component in closed form.) Over a short time, keep = exp(A dt) and the covariance of the error,
// the integral of exp(A s) b bᵀ exp(A s)ᵀ, are power series; a step of twice the length is two steps. Loops of our own: their sums run in
// one order whatever the compiler makes of them.
template <std::size_t n>
struct LinearNoise {
  using Matrix = std::array<std::array<double, n>, n>;
  Matrix keep{}, draw{};

  LinearNoise() = default;
  LinearNoise(const Matrix& a, const std::array<double, n>& b, double dt) {
    double rate = 0;
    for (const auto& row : a)
      for (const double value : row) rate = std::max(rate, std::abs(value));
    int doublings = 0;
    while (std::ldexp(rate * dt, -doublings) > kShort) ++doublings;
    const double h = std::ldexp(dt, -doublings);

    // exp(A h) = sum of A^k h^k / k!, and C' = A C + C Aᵀ + b bᵀ from C = 0: its k-th derivative is that of the one before, taken on.
    Matrix power = identity(), derivative{}, covariance{};
    keep = power;
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) derivative[r][c] = b[r] * b[c];
    double weight = 1;
    for (int k = 1; k <= kTerms; ++k) {
      weight *= h / k;
      power = product(power, a);
      add(keep, power, weight);
      add(covariance, derivative, weight);
      const Matrix once = product(a, derivative);
      for (std::size_t r = 0; r < n; ++r)
        for (std::size_t c = 0; c < n; ++c) derivative[r][c] = once[r][c] + once[c][r];
    }
    for (; doublings > 0; --doublings) {
      const Matrix carried = product(product(keep, covariance), transposed(keep));
      add(covariance, carried, 1);
      keep = product(keep, keep);
    }
    draw = lower_root(covariance);
  }

 private:
  static constexpr double kShort = 0.125;  // of the largest rate
  static constexpr int kTerms = 16;        // n^16 0.125^16 / 16! is below rounding for any n used here

  static Matrix identity() {
    Matrix m{};
    for (std::size_t k = 0; k < n; ++k) m[k][k] = 1;
    return m;
  }
  static Matrix transposed(const Matrix& m) {
    Matrix out{};
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) out[r][c] = m[c][r];
    return out;
  }
  static void add(Matrix& to, const Matrix& m, double weight) {
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) to[r][c] += weight * m[r][c];
  }
  static Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c)
        for (std::size_t k = 0; k < n; ++k) out[r][c] += a[r][k] * b[k][c];
    return out;
  }
  // Cholesky. A variance that is 0, or below 0 by rounding, draws nothing.
  static Matrix lower_root(const Matrix& m) {
    Matrix root{};
    for (std::size_t c = 0; c < n; ++c) {
      double left = m[c][c];
      for (std::size_t k = 0; k < c; ++k) left -= root[c][k] * root[c][k];
      if (!(left > 0)) continue;
      root[c][c] = std::sqrt(left);
      for (std::size_t r = c + 1; r < n; ++r) {
        double value = m[r][c];
        for (std::size_t k = 0; k < c; ++k) value -= root[r][k] * root[c][k];
        root[r][c] = value / root[c][c];
      }
    }
    return root;
  }
};

}  // namespace swarmfit
