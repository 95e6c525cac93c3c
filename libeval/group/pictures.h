// SPDX-License-Identifier: MIT
// What a group looks like beside another: maps around a focal individual, curves over distance and delay, order over time, use of space.
// Recording and simulations are measured on the same grid, so that they can be drawn beside each other.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "libeval/panel.h"
#include "libtrack/tracks.h"

namespace swarmfit {

inline constexpr std::size_t kMapSide = 15;    // squares per side of the maps around an individual
inline constexpr std::size_t kSpaceSide = 28;  // of the map of space use

// Set by the recording.
struct PictureGrid {
  int dims = 3;
  double dt = 1;                       // frame interval [s]
  double reach = 0;                    // half the side of the maps around an individual: four mean nearest-neighbour distances [unit]
  double width = 0;                    // of a bin of distance [unit]
  std::vector<double> even;            // per bin of distance: share of the pairs of an even cloud of the recording's shape
  std::int64_t first = 0, stride = 1;  // frames of the first bin of time, and in every one
  std::size_t times = 0;               // bins of time
  double x = 0, y = 0, half = 0;       // centre and half the side of the map of space use [unit]
  std::int64_t every = 1;              // frames of which pairs are looked at
  PanelPlan plan;                      // delays of autocorrelation and displacement
};
PictureGrid picture_grid(const Tracks& recording);

// All values may be NaN: nothing was there to average. Maps go row by row from behind to ahead, within a row from left to right of the
// focal individual; in space the map is turned about the heading until the neighbour lies to the right, so that the left half is empty.
struct Pictures {
  std::vector<double> density;       // neighbours per square, over those of an even cloud (in space, squares stand for rings)
  std::vector<double> turning;       // mean turning rate of the focal individual to its right; in space towards the neighbour [rad/s]
  std::vector<double> acceleration;  // its mean acceleration along its heading [unit/s²]
  std::vector<double> pairs;         // per bin of distance: pairs, over those of the even cloud of the grid, g(r)
  std::vector<double> headings;      // per bin of distance: mean ê_i·ê_j
  std::vector<double> vacf, msd;     // per delay of the grid, of the panel (libeval/panel.h); msd [unit²]
  std::vector<double> polarisation, milling, spread;  // per bin of time, of the order table; spread is its extent [unit]
  std::vector<double> space;                          // positions per square seen from above, over the mean of all squares
};
inline auto fields(Pictures& p) {
  return std::tie(p.density, p.turning, p.acceleration, p.pairs, p.headings, p.vacf, p.msd, p.polarisation, p.milling, p.spread, p.space);
}

Pictures pictures(const Tracks& tracks, const PictureGrid& grid);

// Mean and standard deviation over several, value by value, of those that are finite; NaN where fewer than one or two are.
struct PictureSpread {
  Pictures mean, sd;
};
PictureSpread picture_spread(const std::vector<Pictures>& all);

}  // namespace swarmfit
