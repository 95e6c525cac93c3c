// SPDX-License-Identifier: MIT
// Discrete probability densities of the metrics and the L1 distance ("energy") between recording and simulation
// (Ren et al. 2016, Par-Est steps 2-4, Eq 7).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "libeval/metrics.h"

namespace swarmfit {

// By whose mean and standard deviation values are z-scored before they are binned.
enum class Normalisation {
  reference,  // both sets by the recording's: a model that is wrong in scale pays (default)
  separate,   // each set by its own, as the paper does: only the shape is compared
  none,       // physical units: the recording's 0.5 % .. 99.5 % quantile range is laid on [lower, upper]
};

struct Binning {
  Normalisation normalisation = Normalisation::reference;
  double lower = -5, upper = 10;  // u1, u2 of the z-scores (separate, none: -5, 5)
  int bins = 150;                 // M (separate, none: 100)
  bool clip = true;               // samples outside are counted in the end bins too (separate: false)
  bool pooled = false;            // runs of a model are pooled and compared, as published (separate: true), else scored (energy_score.h)
  static Binning standard(Normalisation);
};

// A histogram with equal bins on [lower, upper], the last bin closed. Counts add up over replicates.
struct Histogram {
  std::vector<std::uint64_t> counts;
  std::uint64_t samples = 0;  // all, those outside included; NaN is no sample
  std::uint64_t outside = 0;
  void add(const Histogram& other);  // throws std::invalid_argument if the bins differ
};

// A discrete PDF: Q_i = S_i M / (S (u2 - u1)); empty when there is no sample.
std::vector<double> density(const Histogram&, double lower, double upper);

// First two moments of one metric, addable over replicates. Values that are not finite are passed over.
struct Moments {
  std::uint64_t count = 0;
  double mean = 0;
  double m2 = 0;  // sum of squared deviations
  void add(double x);
  void add(const Moments& other);
  double sd() const;              // population; NaN without samples
  double standard_error() const;  // of the mean; NaN for fewer than two
};

// What one set of tracks (or several replicates pooled) looks like to the evaluator.
struct Distribution {
  Histogram histogram;  // without samples where the metric is undefined
  Moments moments;
};

using Energies = PerColumn<double>;  // NaN: undefined

using Densities = PerColumn<std::vector<double>>;  // discrete PDFs; empty: no samples

inline constexpr double kUnseen = 1.0 / 200;  // of the worst energy: differences that no ranking sees

// Signed differences of a simulated set from the recording: kDifferences numbers per column, column by column.
using Differences = std::vector<double>;
inline constexpr std::size_t kDifferences = 5;

inline constexpr double kMostMisplaced = 7;  // Target::misplacement: about 1100 standard deviations off

// The recording, prepared once; scores any number of simulations. Immutable, shared by threads.
//
// The standard deviation of a z-score is never taken as less than 1 % of |mean| (of eta: of its natural scale), nor so small that a bin
// would be narrower than what rounding puts on the metric (MetricSamples::rounding). A metric that varies less than that is a fact to be
// matched: its mean lies in the middle of a bin. A metric whose standard deviation is below 1e-9 of its
// natural scale is a constant with rounding, and undefined: of the recording, or under `separate` of the simulation.
class Target {
 public:
  // Has the columns of the recording's samples. Throws std::invalid_argument on a binning without bins or interval.
  Target(const MetricSamples& recording, const Binning& binning);

  // Bins simulated samples on the recording's axes (Normalisation::separate: by their own moments, so replicates that are pooled by adding
  // distributions are each normalised by themselves). The samples must have the same columns.
  PerColumn<Distribution> distributions(const MetricSamples& simulated) const;
  // E = sum_i |Q_real,i - Q_sim,i| per column, in [0, 2M/(u2-u1)]. Undefined metrics and metrics without samples are NaN.
  Energies energies(const PerColumn<Distribution>& simulated) const;
  // The same between two sets that were binned on the recording's axes; NaN where one has no samples.
  Energies energies_between(const PerColumn<Distribution>& one, const PerColumn<Distribution>& other) const;
  // Discrete PDFs of a set that was binned on the recording's axes; empty where it has no samples.
  Densities densities(const PerColumn<Distribution>& simulated) const;
  // How far off the simulated means are, ln(1 + |difference| / scale of the z-score), at most kMostMisplaced. Distributions that do not
  // overlap all have the same energy, however far apart they are; this tells a search which way is nearer. 0 where energies are NaN, and
  // throughout under Normalisation::separate, where means do not count.
  PerColumn<double> misplacement(const PerColumn<Distribution>& simulated) const;
  // In which direction a set differs, where energies say only how much: differences x of the three quartiles and of the mean, in units of
  // the z-score's scale and as ±ln(1 + |x|), and the logarithm of the ratio of standard deviations. 0 where energies are NaN; the last
  // two also under Normalisation::separate, where means and deviations do not count.
  Differences differences(const PerColumn<Distribution>& simulated) const;

  const std::vector<Column>& columns() const { return columns_; }
  const PerColumn<Distribution>& recording() const { return recording_; }
  const Binning& binning() const { return binning_; }
  // The recording's axis of one column in physical units: bin i covers [lower + i*width, lower + (i+1)*width), the last one closed.
  struct Axis {
    double lower, width;
  };
  Axis axis(std::size_t column) const;
  bool defined(std::size_t column) const { return defined_[column]; }  // false: constant or without samples
  double worst() const;                                                // 2M/(u2-u1): the energy of disjoint distributions

 private:
  double off_by(std::size_t column, const Moments& now) const;  // signed misplacement

  Binning binning_;
  std::vector<Column> columns_;
  PerColumn<Distribution> recording_;
  PerColumn<std::vector<double>> pdf_;
  PerColumn<double> shift_, scale_;             // z = (x - shift) / scale
  PerColumn<std::array<double, 3>> quartiles_;  // of the recording, in bins
  PerColumn<bool> defined_;
};

}  // namespace swarmfit
