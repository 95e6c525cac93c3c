// SPDX-License-Identifier: MIT
// The methods of a run as text to paste into a paper.
#pragma once

#include <string>
#include <vector>

#include "fit/results/comparison.h"
#include "libeval/evaluation.h"

namespace swarmfit {

// Plain text of any origin; numbers in brackets refer to the references, from 1.
struct Methods {
  std::vector<std::string> paragraphs, references;
};
Methods methods(const Comparison&);
// Version of the program; recorded velocities: those of the files were measured, not differences of positions.
Methods methods(const Evaluation&, bool recorded_velocities, const std::string& version);

std::string methods_markdown(const Comparison&);
std::string methods_latex(const Comparison&);

}  // namespace swarmfit
