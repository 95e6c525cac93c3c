// SPDX-License-Identifier: MIT
// What a comparison says of its data and its method, and what a reader must be warned of.
#pragma once

#include "fit/compare/compare.h"

namespace swarmfit {

// Per column, the difference of energies that the recording can tell: the larger of
//   - the energy by which it scatters about the process that made it. Halves of it hold half the samples each, so the recording is half as
//     far from the process as they are from one another. Not if options.resolution is false, or it has too few frames.
//   - where the column is mostly localisation error, the energy between the recording and itself with the same error once more: what could
//     be gained by misjudging the error is not to decide.
PerColumn<double> resolution(const Conditions&, const Target&, const CompareOptions&, const PerColumn<bool>& error_dominated);

ObservationFacts observation_facts(const Conditions& conditions, const Target& target, const CompareOptions& options);

// Lags at which both sides are measured: those asked for, or chosen so that the signal exceeds the localisation error. Throws InputError
// where the tracks are too short for them.
std::vector<int> lags_for(const Conditions& conditions, const CompareOptions& options);

// What the recording is; not of one without rows.
DataFacts data_facts(const Tracks& recording, const Scales& scales);

// The recording's distributions and their axes; nothing else is known yet.
RecordingFacts measured_facts(const Target& target);

// What each lag contributes to the score under these weights.
std::vector<LagFacts> lag_facts(const RecordingFacts& recording, const PerColumn<double>& weights);

// One sentence each, in order of weight, from a finished result.
std::vector<Warning> warnings_for(const Comparison& result);

}  // namespace swarmfit
