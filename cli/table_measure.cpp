// SPDX-License-Identifier: MIT
// Settings: what is measured of a group.
#include <utility>

#include "cli/tables.h"

namespace swarmfit::cli {
namespace {

constexpr double kFarthest = 1e9;       // in any unit
constexpr double kLongestWindow = 1e7;  // frames

constexpr double kMostRuns = 10'000;  // per cell
constexpr double kMostPoints = 1e6;

void window(Arguments& a, const Value& v) { a.measure.window = v.whole<std::int64_t>(); }

std::vector<Setting> of_sweep() {
  return {
      {.name = "axis",
       .in = kSweep,
       .help = "what is varied: a parameter, an option of the model, or a number of the scene such as agents; name=lo:hi:n, "
               "name=lo:hi:n:log or name=value,value,...; given again for another axis",
       .allowed = texts(),
       .use =
           [](Arguments& a, const Value& v) {
             for (const std::string& word : v.words) a.sweep.axes.push_back(parse_axis(word));
           }},
      {.name = "latin",
       .in = kSweep,
       .help = "instead of the grid, this many points of a Latin hypercube between the ends of the axes",
       .allowed = whole(1, kMostPoints),
       .use = [](Arguments& a, const Value& v) { a.sweep.latin = v.whole<int>(); }},
      {.name = "hysteresis",
       .in = kSweep,
       .help = "go up the first axis and down again, each cell starting where the last one ended",
       .allowed = on_or_off(),
       .use = [](Arguments& a, const Value& v) { a.sweep.hysteresis = v.on(); }},
      {.name = "seeds",
       .in = kSweep,
       .help = "runs per cell, their seeds counting up from --seed",
       .allowed = whole(1, kMostRuns),
       .initial = "5",
       .use = [](Arguments& a, const Value& v) { a.seeds = v.whole<int>(); }},
      {.name = "every",
       .in = kSweep,
       .help = "measure every n-th frame",
       .allowed = whole(1, kLongestWindow),
       .initial = "1",
       .use = [](Arguments& a, const Value& v) { a.sweep.every = v.whole<std::int64_t>(); }},
      {.name = "window",
       .in = kSweep,
       .help = "frames from which the state of the group is found; the state of a run is its last",
       .allowed = whole(1, kLongestWindow),
       .initial = "200",
       .use = window},
  };
}

std::vector<Setting> of_both() {
  return {
      {.name = "quantities",
       .in = kMeasure | kSweep,
       .help = "order parameters to measure, separated by commas: polarisation,extent, ...; or usual, or all",
       .allowed = split_texts(),
       .initial = "all",
       .elsewhere = {kSweep, "usual"},
       .use = [](Arguments& a, const Value& v) { a.measure.what = order_parameters_named(v.words); }},
      {.name = "link",
       .in = kMeasure | kSweep,
       .help = "individuals closer than this belong to one subgroup [unit]; if not given, 5 (plane) or 3 (space) times the mean "
               "distance to the nearest",
       .allowed = above(0, kFarthest),
       .use = [](Arguments& a, const Value& v) { a.measure.link = v.number(); }},
      {.name = "states",
       .in = kMeasure | kSweep,
       .help = "which set of states: group: swarm, mills, aligned, chains, figure of eight; flock: vortex, comet, compact, "
               "cohesive, convergence",
       .allowed = one_of({"group", "flock"}),
       .initial = "group",
       .use = [](Arguments& a, const Value& v) { a.measure.words = v.text() == "flock" ? StateWords::flock : StateWords::group; }},
      {.name = "window",
       .in = kMeasure,
       .help = "frames from which the state of the group is found; if not given, as many as are needed to move twice the group's extent",
       .allowed = whole(1, kLongestWindow),
       .use = window},
  };
}

}  // namespace

std::vector<Setting> measure_settings() {
  std::vector<Setting> all = of_sweep();
  for (Setting& s : of_both()) all.push_back(std::move(s));
  return all;
}

}  // namespace swarmfit::cli
