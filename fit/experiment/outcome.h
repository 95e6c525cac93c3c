// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <vector>

#include "libeval/energy.h"
#include "libswarm/simulate.h"

namespace swarmfit {

// One replicate of a candidate.
struct ScoredRun {
  PerColumn<Distribution> distributions;
  MetricSamples samples;  // only where pooling needs them: z-scores of a pooled set are not those of its parts
  Energies raw;
  Counters count;
  bool failed = false;  // blew up
};

// One candidate over its replicates.
struct Outcome {
  // Energy score, or energy of the pooled replicates (Binning::pooled). Replicates that blew up count with the worst energy; NaN: undefined
  // in the recording.
  Energies raw;
  Energies guided;                        // raw, and a little more the farther off the means are: what a search minimises
  Energies first;                         // guided energies of the first replicates alone, where a race asked for them
  std::vector<Energies> replicates;       // of each replicate: EnergyScore::runs, or alone
  PerColumn<Distribution> distributions;  // pooled replicates
  Differences differences;                // of the pooled replicates; none if one blew up
  int failed = 0;                         // replicates that blew up
  Counters count;                         // summed
};

// One run, binned on the recording's axes.
struct SingleRun {
  PerColumn<Distribution> distributions;  // without samples if it blew up
  bool failed = false;
};

// As bytes (fit/store/bytes.h).
inline auto fields(Histogram& h) { return std::tie(h.counts, h.samples, h.outside); }
inline auto fields(Distribution& d) { return std::tie(d.histogram, d.moments); }
inline auto fields(MetricSamples& s) { return std::tie(s.columns, s.values, s.rows, s.undefined, s.natural, s.rounding); }
inline auto fields(ScoredRun& r) { return std::tie(r.distributions, r.samples, r.raw, r.count, r.failed); }
inline auto fields(SingleRun& r) { return std::tie(r.distributions, r.failed); }

}  // namespace swarmfit
