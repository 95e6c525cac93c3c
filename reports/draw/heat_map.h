// SPDX-License-Identifier: MIT
// Values over a grid as colours.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/draw/axis.h"
#include "reports/draw/svg.h"

namespace swarmfit::plot {

// "#rrggbb" for a share from 0 to 1: from dark blue by green to yellow, ever lighter, so that it survives grey print and colour blindness
// (points of viridis: Smith and van der Walt 2015). Grey for what is not finite.
std::string heat_colour(double share);

// One value per cell; x runs along columns, y upwards along rows.
struct HeatMap {
  std::vector<double> x, y;          // centres of columns and rows, ascending
  std::vector<double> value;         // row by row, y.size() × x.size(); NaN: grey
  std::vector<std::string> label{};  // per cell, for the pointer; none: the value alone
  std::string x_title, y_title, value_title;
  bool x_log = false, y_log = false;
  double lower = 0, upper = 0;  // of the colours; equal: those of the values
};

// A map with its axes and a bar of colours in this box, which leaves room for labels.
void draw_heat_map(svg::Sheet& sheet, const svg::Box& box, const HeatMap& map);

// One of a few names per cell, for maps of states: the colours of series; a legend stands beneath.
struct NameMap {
  std::vector<double> x, y;
  std::vector<int> value;          // index of a name; -1: grey
  std::vector<double> share;       // of the runs that agree, 0 to 1: paler where few do
  std::vector<std::string> names;  // at most eight are told apart
  std::vector<std::string> label{};
  std::string x_title, y_title;
  bool x_log = false, y_log = false;
};
void draw_name_map(svg::Sheet& sheet, const svg::Box& box, const NameMap& map);

}  // namespace swarmfit::plot
