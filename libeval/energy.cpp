// SPDX-License-Identifier: MIT
#include "libeval/energy.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "libtrack/hot.h"
#include "libtrack/nan.h"
#include "libtrack/quantile.h"

namespace swarmfit {
namespace {

constexpr double kSpreadFloor = 0.01;  // of |mean|, or of the natural scale of eta: a standard deviation never counts as smaller
constexpr double kRounding = 1e-9;     // of the natural scale: a smaller standard deviation is rounding

double total(const Lanes& lanes) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); }

// Sum of (x - shift)^power, power 1 or 2, in four partial sums.
template <int power>
inline __attribute__((always_inline)) double power_sum(const double* x, std::size_t n, double shift) {
  Lanes sums{};
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    Lanes d;
    load(x + i, d);
    d -= shift;
    sums += power == 1 ? d : d * d;
  }
  for (; i < n; ++i) sums[i % 4] += power == 1 ? x[i] - shift : (x[i] - shift) * (x[i] - shift);
  return total(sums);
}

SWARMFIT_HOT Moments two_passes(const double* x, std::size_t n) {
  // From the first value on, so that a constant has no spread, not even by rounding.
  const double mean = x[0] + power_sum<1>(x, n, x[0]) / static_cast<double>(n);
  return {n, mean, power_sum<2>(x, n, mean)};
}

Moments moments(const std::vector<double>& values) {
  if (values.empty()) return {};
  const Moments m = two_passes(values.data(), values.size());
  if (std::isfinite(m.m2)) return m;
  Moments one_by_one;
  for (const double x : values) one_by_one.add(x);
  return one_by_one;
}

// Is there a distribution to speak of, or a constant with its rounding?
bool varies(const Moments& m, double natural) { return m.count > 0 && m.m2 > 0 && m.sd() >= kRounding * natural; }

// The middle of the bin that holds 0.
double middle_of_zero(const Binning& b) {
  const double width = (b.upper - b.lower) / b.bins;
  return (std::round(-b.lower / width - 0.5) + 0.5) * width + b.lower;
}

// z = (x - shift) / scale
struct ZScore {
  double shift, scale;
};
ZScore z_score(const Moments& m) { return {m.mean, std::max(m.sd(), kSpreadFloor * std::abs(m.mean))}; }

// That of a recording: no bin is narrower than what rounding puts on the metric. A deviation that is smaller is next to none, and the
// metric a fact that simulations have to match: its mean lies in the middle of a bin then, not on the edge between two.
ZScore z_score(const Moments& m, const Binning& b, double rounding, double natural) {
  ZScore z = z_score(m);
  z.scale = std::max({z.scale, kSpreadFloor * natural, rounding * b.bins / (b.upper - b.lower)});
  if (z.scale > m.sd()) z.shift -= z.scale * middle_of_zero(b);
  return z;
}

// The z-score that maps [low, high] onto the binning's interval.
ZScore onto_interval(double low, double high, const Binning& b) {
  const double scale = (high - low) / (b.upper - b.lower);
  return {low - scale * b.lower, scale};
}

// The bins of n values, a multiple of 4; a z-score outside gets the bin at its end. Returns how many are outside, or -1 if one is NaN.
SWARMFIT_HOT std::int64_t bins_of(const double* x, std::size_t n, const ZScore& z, const Binning& b, std::int32_t* bin) {
  using Four = std::int32_t __attribute__((vector_size(16)));
  const double per_unit = b.bins / (b.upper - b.lower);
  const Lanes lower = Lanes{} + b.lower, upper = Lanes{} + b.upper, last = Lanes{} + (b.bins - 1);
  LaneMask outside{}, undefined{};  // a comparison that holds is -1
  for (std::size_t i = 0; i < n; i += 4) {
    Lanes value;
    load(x + i, value);
    const Lanes score = (value - z.shift) / z.scale;
    outside -= (score < lower) | (score > upper);
    undefined |= score != score;  // NaN  NOLINT(misc-redundant-expression)
    const Lanes high = score > upper ? upper : score, within = high >= lower ? high : lower;
    const Lanes place = (within - lower) * per_unit;
    const Four bins = __builtin_convertvector(place < last ? place : last, Four);
    std::memcpy(bin + i, &bins, sizeof bins);
  }
  if (undefined[0] | undefined[1] | undefined[2] | undefined[3]) return -1;
  return (outside[0] + outside[1]) + (outside[2] + outside[3]);
}

void count_one(double x, const ZScore& z, const Binning& b, Histogram& h) {
  const auto last = static_cast<std::size_t>(b.bins - 1);
  const double score = (x - z.shift) / z.scale;
  if (std::isnan(score)) return;
  ++h.samples;
  if (score >= b.lower && score <= b.upper) {  // so the cast below is safe
    ++h.counts[std::min(static_cast<std::size_t>((score - b.lower) * (b.bins / (b.upper - b.lower))), last)];
  } else {
    ++h.outside;
    if (b.clip) ++h.counts[score < b.lower ? 0 : last];
  }
}

Histogram histogram(const std::vector<double>& values, const ZScore& z, const Binning& b) {
  constexpr std::size_t block = 256;
  Histogram h{std::vector<std::uint64_t>(static_cast<std::size_t>(b.bins), 0), 0, 0};
  std::int32_t bin[block];
  std::size_t i = 0;
  for (; i + block <= values.size(); i += block) {
    const std::int64_t outside = bins_of(values.data() + i, block, z, b, bin);
    if (outside == 0 || (outside > 0 && b.clip)) {
      for (const std::int32_t k : bin) ++h.counts[static_cast<std::size_t>(k)];
      h.samples += block;
      h.outside += static_cast<std::uint64_t>(outside);
    } else {
      for (std::size_t k = i; k < i + block; ++k) count_one(values[k], z, b, h);
    }
  }
  for (; i < values.size(); ++i) count_one(values[i], z, b, h);
  return h;
}

// Quartiles of what a histogram counts, in bins from its lower end, linear within a bin.
std::array<double, 3> quartiles(const Histogram& h) {
  std::array<double, 3> out{};
  double below = 0, total = 0;
  for (const std::uint64_t n : h.counts) total += static_cast<double>(n);
  for (std::size_t i = 0, q = 0; i < h.counts.size() && q < 3; ++i) {
    const auto here = static_cast<double>(h.counts[i]);
    for (; q < 3 && below + here >= total * (static_cast<double>(q) + 1) / 4; ++q)
      out[q] = static_cast<double>(i) + (here > 0 ? (total * (static_cast<double>(q) + 1) / 4 - below) / here : 0);
    below += here;
  }
  return out;
}

double compressed(double difference) { return std::copysign(std::min(std::log1p(std::abs(difference)), kMostMisplaced), difference); }

// Sum of absolute differences; NaN without samples.
double l1_distance(const std::vector<double>& p, const std::vector<double>& q) {
  if (p.empty() || q.empty()) return kNaN;
  if (p.size() != q.size()) throw std::invalid_argument("Target: bins differ");
  double sum = 0;
  for (std::size_t i = 0; i < q.size(); ++i) sum += std::abs(p[i] - q[i]);
  return sum;
}

}  // namespace

Binning Binning::standard(Normalisation normalisation) {
  switch (normalisation) {
    case Normalisation::separate:
      return {normalisation, -5, 5, 100, false, true};
    case Normalisation::none:
      return {normalisation, -5, 5, 100, true};
    case Normalisation::reference:
      break;
  }
  return {};
}

void Histogram::add(const Histogram& other) {
  if (counts.empty()) counts.resize(other.counts.size());
  if (!other.counts.empty() && other.counts.size() != counts.size()) throw std::invalid_argument("Histogram::add: bins differ");
  for (std::size_t i = 0; i < other.counts.size(); ++i) counts[i] += other.counts[i];
  samples += other.samples;
  outside += other.outside;
}

std::vector<double> density(const Histogram& h, double lower, double upper) {
  if (h.samples == 0) return {};
  const double unit = static_cast<double>(h.counts.size()) / (static_cast<double>(h.samples) * (upper - lower));
  std::vector<double> q;
  q.reserve(h.counts.size());
  for (const std::uint64_t n : h.counts) q.push_back(static_cast<double>(n) * unit);
  return q;
}

// Welford 1962
void Moments::add(double x) {
  if (!std::isfinite(x)) return;
  ++count;
  const double delta = x - mean;
  mean += delta / static_cast<double>(count);
  m2 += delta * (x - mean);
}

// Chan, Golub and LeVeque 1979
void Moments::add(const Moments& other) {
  if (other.count == 0) return;
  const auto n = static_cast<double>(count), k = static_cast<double>(other.count);
  const double delta = other.mean - mean;
  mean += delta * (k / (n + k));
  m2 += other.m2 + delta * delta * (n * k / (n + k));
  count += other.count;
}

double Moments::sd() const { return count == 0 ? kNaN : std::sqrt(m2 / static_cast<double>(count)); }

double Moments::standard_error() const {
  const auto n = static_cast<double>(count);
  return n > 1 ? std::sqrt(m2 / (n - 1) / n) : kNaN;
}

Target::Target(const MetricSamples& recording, const Binning& binning)
    : binning_(binning),
      columns_(recording.columns),
      recording_(columns_.size()),
      pdf_(columns_.size()),
      shift_(columns_.size()),
      scale_(columns_.size()),
      quartiles_(columns_.size()),
      defined_(columns_.size()) {
  if (binning.bins < 1 || !(binning.lower < binning.upper) || !std::isfinite(binning.upper - binning.lower))
    throw std::invalid_argument("Binning: needs at least one bin and a finite interval");
  for (std::size_t m = 0; m < columns_.size(); ++m) {
    const auto& values = recording.values[m];
    Distribution& own = recording_[m];
    own.moments = moments(values);
    // Differences of speeds that are all the same are rounding, and so is their mean.
    const double natural = columns_[m].metric == kVelocityDifference ? recording.natural[m] : 0;
    ZScore z = binning.normalisation == Normalisation::reference ? z_score(own.moments, binning, recording.rounding[m], natural)
                                                                 : z_score(own.moments);
    defined_[m] = varies(own.moments, recording.natural[m]);
    if (defined_[m] && binning.normalisation == Normalisation::none) {
      z = onto_interval(quantile(values, 0.005), quantile(values, 0.995), binning);
      defined_[m] = z.scale > 0;
    }
    shift_[m] = z.shift;
    scale_[m] = z.scale;
    if (!defined_[m]) continue;
    own.histogram = histogram(values, z, binning);
    pdf_[m] = density(own.histogram, binning.lower, binning.upper);
    quartiles_[m] = quartiles(own.histogram);
  }
}

PerColumn<Distribution> Target::distributions(const MetricSamples& simulated) const {
  PerColumn<Distribution> out(columns_.size());
  for (std::size_t m = 0; m < columns_.size(); ++m) {
    const auto& values = simulated.values[m];
    out[m].moments = moments(values);
    if (!defined_[m]) continue;
    const bool own = binning_.normalisation == Normalisation::separate;
    if (own && !varies(out[m].moments, simulated.natural[m])) continue;
    out[m].histogram = histogram(values, own ? z_score(out[m].moments) : ZScore{shift_[m], scale_[m]}, binning_);
  }
  return out;
}

Energies Target::energies(const PerColumn<Distribution>& simulated) const {
  Energies energy(columns_.size(), kNaN);
  for (std::size_t m = 0; m < columns_.size(); ++m)
    energy[m] = l1_distance(pdf_[m], density(simulated[m].histogram, binning_.lower, binning_.upper));
  return energy;
}

Energies Target::energies_between(const PerColumn<Distribution>& one, const PerColumn<Distribution>& other) const {
  Energies energy(columns_.size(), kNaN);
  for (std::size_t m = 0; m < columns_.size(); ++m)
    energy[m] =
        l1_distance(density(one[m].histogram, binning_.lower, binning_.upper), density(other[m].histogram, binning_.lower, binning_.upper));
  return energy;
}

Densities Target::densities(const PerColumn<Distribution>& simulated) const {
  Densities out(columns_.size());
  for (std::size_t m = 0; m < columns_.size(); ++m) out[m] = density(simulated[m].histogram, binning_.lower, binning_.upper);
  return out;
}

double Target::off_by(std::size_t column, const Moments& now) const {
  return compressed((now.mean - recording_[column].moments.mean) / scale_[column]);
}

PerColumn<double> Target::misplacement(const PerColumn<Distribution>& simulated) const {
  PerColumn<double> off(simulated.size(), 0.0);
  if (binning_.normalisation == Normalisation::separate) return off;
  for (std::size_t m = 0; m < simulated.size(); ++m)
    if (defined_[m] && simulated[m].moments.count > 0) off[m] = std::abs(off_by(m, simulated[m].moments));
  return off;
}

Differences Target::differences(const PerColumn<Distribution>& simulated) const {
  Differences out(simulated.size() * kDifferences, 0.0);
  for (std::size_t m = 0; m < simulated.size(); ++m) {
    const Moments &now = simulated[m].moments, &then = recording_[m].moments;
    if (!defined_[m] || simulated[m].histogram.samples == 0) continue;
    double* at = &out[m * kDifferences];
    const auto places = quartiles(simulated[m].histogram);
    for (std::size_t q = 0; q < 3; ++q)
      at[q] = compressed((places[q] - quartiles_[m][q]) * (binning_.upper - binning_.lower) / binning_.bins);
    if (binning_.normalisation == Normalisation::separate || now.count == 0) continue;
    at[3] = off_by(m, now);
    at[4] = std::log((now.sd() + kSpreadFloor * scale_[m]) / (then.sd() + kSpreadFloor * scale_[m]));
  }
  return out;
}

Target::Axis Target::axis(std::size_t column) const {
  return {shift_[column] + scale_[column] * binning_.lower, scale_[column] * (binning_.upper - binning_.lower) / binning_.bins};
}

double Target::worst() const { return 2 * binning_.bins / (binning_.upper - binning_.lower); }

}  // namespace swarmfit
