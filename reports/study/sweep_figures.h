// SPDX-License-Identifier: MIT
// A sweep, drawn.
#pragma once

#include <string>
#include <vector>

#include "fit/results/sweep.h"

namespace swarmfit {

struct SweepFigure {
  std::string name, title;  // of the file without ending; in words
  std::string svg;
};

// Of a grid over one axis a curve per order parameter, over two or three maps and curves; the third axis gives a figure per value, twelve
// at most. Up-and-down sweeps: both branches in one panel. Of a Latin hypercube a cloud of points per pair of axes.
std::vector<SweepFigure> sweep_figures(const Sweep& sweep, const std::string& unit);

}  // namespace swarmfit
