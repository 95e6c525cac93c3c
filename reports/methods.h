// SPDX-License-Identifier: MIT
// The methods of a run as text to paste into a paper.
#pragma once

#include <string>
#include <vector>

#include "fit/results.h"
#include "libeval/evaluation.h"

namespace swarmfit {

// Plain text of any origin; numbers in brackets refer to the references, from 1.
struct Methods {
  std::vector<std::string> paragraphs, references;
};
Methods methods(const Comparison&);
Methods methods(const Evaluation&, const std::string& version);  // of the program

std::string methods_markdown(const Comparison&);
std::string methods_latex(const Comparison&);

}  // namespace swarmfit
