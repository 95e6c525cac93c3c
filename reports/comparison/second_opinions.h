// SPDX-License-Identifier: MIT
// Parameters by other ways than the search, in words.
#pragma once

#include <string>

#include "fit/results/model_fit.h"

namespace swarmfit {

// "0.61 (0.55 .. 0.68)"; kUndefined if that is not known.
std::string opinion_text(const SecondOpinion&);

// "tau_v 0.61 (0.55 .. 0.68) s, ...": of a model that has a likelihood; else empty.
std::string most_likely_values(const ModelFit&);
std::string regressed_values(const ModelFit&);  // the same of a model whose accelerations were regressed

}  // namespace swarmfit
