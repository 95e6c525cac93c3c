// SPDX-License-Identifier: MIT
// The figures of a comparison as a paper prints them: SVG, one column (85 mm) or two (178 mm) wide, and what is written beneath them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/results/comparison.h"

namespace swarmfit {

struct Figure {
  std::string name;     // "scores": figures/scores.svg
  std::string caption;  // sentences that make it readable alone; names whatever is undefined and so not drawn
  std::string svg;
};

// densities (all metrics), density_KEY for each, scores, energies, convergence, parameters, neighbours, responses, curves, forces, order,
// space, posterior_RANK; those with nothing to draw are left out. A metric at another lag than 1 is called v_lag4.
std::vector<Figure> figures(const Comparison&);

// Is this the file of such a figure, of whatever run? "density_v_lag4.svg"
bool is_figure(std::string_view file_name);

// The captions of all, in the order of the figures.
std::string captions_markdown(const std::vector<Figure>&);
// The same as figure environments; needs \usepackage{graphicx}, and the figures as PDF in figures/.
std::string captions_latex(const std::vector<Figure>&);

}  // namespace swarmfit
