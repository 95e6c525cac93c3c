// SPDX-License-Identifier: MIT
// Figure 7 of Xiang et al. 2020 (doi:10.1002/cav.1957), on what was not learned: speed, distance to the nearest neighbour and acceleration
// along x, y and z of fastswarm and bswarm, beside the recording. Models are fitted to the first 45 % of the frames and simulated in the
// place of the last 45 %, where individuals enter as recorded. Distances are those of histograms of 50 bins between the 0.5 and the 99.5 %
// quantile of the recorded values, means over runs with their central 95 %. The first part of the recording is the yardstick. By hand:
//   distributions FILE [RUNS] [FIRST:LAST] [COLUMNS] [UNIT] [BUDGET]
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fit/compare/compare.h"
#include "fit/experiment/ensemble.h"
#include "libeval/distance.h"
#include "libeval/nearest.h"
#include "libtrack/cut.h"
#include "libtrack/error.h"
#include "libtrack/quantile.h"
#include "libtrack/read/read.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Values = std::array<std::vector<double>, 5>;

constexpr std::array<const char*, 5> kNames{"speed", "nearest neighbour", "acceleration, x", "acceleration, y", "acceleration, z"};
constexpr std::size_t kBins = 50;

Array3d place(const Tracks& tracks, Index row) { return tracks.pos().row(row).transpose(); }

// By forward differences, as the paper's.
Values values_of(const Tracks& tracks) {
  Values out;
  const double dt = tracks.dt();
  for (Index row = 0; row < tracks.rows(); ++row) {
    const Index next = tracks.next()[static_cast<std::size_t>(row)];
    if (next < 0) continue;
    const Array3d v = (place(tracks, next) - place(tracks, row)) / dt;
    out[0].push_back(std::sqrt(v.square().sum()));
    const Index after = tracks.next()[static_cast<std::size_t>(next)];
    if (after < 0) continue;
    const Array3d a = ((place(tracks, after) - place(tracks, next)) / dt - v) / dt;
    for (std::size_t axis = 0; axis < 3; ++axis) out[2 + axis].push_back(a[static_cast<Index>(axis)]);
  }
  for (const FrameRange& f : tracks.frames()) {
    const auto near = nearest_others(tracks.pos().middleRows(f.first, f.count)).distance;
    if (near.size() > 1) out[1].insert(out[1].end(), near.begin(), near.end());
  }
  return out;
}

struct Ruler {
  double low, width;

  explicit Ruler(const std::vector<double>& recorded) : low(quantile(recorded, 0.005)), width((quantile(recorded, 0.995) - low) / kBins) {}
  Histogram histogram(const std::vector<double>& values) const {
    Histogram h{std::vector<std::uint64_t>(kBins), values.size(), 0};
    for (const double x : values) ++h.counts[static_cast<std::size_t>(std::clamp((x - low) / width, 0.0, kBins - 1.0))];
    return h;
  }
};

std::string estimate(const std::vector<double>& runs) {
  double sum = 0;
  for (const double r : runs) sum += r / static_cast<double>(runs.size());
  return runs.size() < 2 ? fmt::format("{:.3g}", sum)
                         : fmt::format("{:.3g} [{:.3g}, {:.3g}]", sum, quantile(runs, 0.025), quantile(runs, 0.975));
}

void print(const char* name, const Values& recorded, const std::vector<Values>& runs) {
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (recorded[k].empty() || !(Ruler(recorded[k]).width > 0)) continue;  // a plane has no z
    const Ruler ruler(recorded[k]);
    const Histogram truth = ruler.histogram(recorded[k]);
    std::vector<double> variation, distance;
    for (const Values& run : runs) {
      const Histogram h = ruler.histogram(run[k]);
      variation.push_back(total_variation(truth, h));
      distance.push_back(wasserstein(truth, h, ruler.width));
    }
    fmt::print("| {} | {} | {} | {} |\n", name, kNames[k], estimate(variation), estimate(distance));
  }
  std::fflush(stdout);
}

void compare_distributions(const Tracks& recording, int runs, const std::string& budget) {
  const std::int64_t first = recording.frames().front().number, last = recording.frames().back().number, part = (last - first) * 45 / 100;
  const Tracks learned = cut(recording, first, first + part), held = cut(recording, last - part, last);
  const Conditions fitted = make_conditions(learned, {}), there = held_out_conditions(held, fitted);
  const Values recorded = values_of(there.recording);
  fmt::print("| who | quantity | total variation | 1-Wasserstein [{}, s] |\n|---|---|---|---|\n", recording.meta().unit);
  print("recording, the part that was learned", recorded, {values_of(fitted.recording)});
  for (const char* name : {"fastswarm", "bswarm"}) {
    const ModelChoice model = parse_model(name);
    CompareOptions options;
    options.models = {model};
    options.budget = budget_named(budget);
    options.bootstrap_recordings = 0;
    const Comparison found = compare(learned, options);
    const Ensemble ensemble(model, there);
    std::vector<Values> seen;
    for (const Job& job : jobs_on(parameter_values(model, found.models.front()), replicate_seeds({7}, Stream::final_seeds, runs)))
      seen.push_back(values_of(ensemble.run(job).seen));
    print(name, recorded, seen);
  }
}

}  // namespace
}  // namespace swarmfit

int main(int argc, char** argv) {
  using namespace swarmfit;
  const auto word = [&](int k, const char* otherwise) { return std::string(argc > k ? argv[k] : otherwise); };
  if (argc < 2) return fmt::print(stderr, "distributions FILE [RUNS] [FIRST:LAST] [COLUMNS] [UNIT] [BUDGET]\n"), 2;
  try {
    ReadOptions options;
    const std::string frames = word(3, ":");
    if (const auto colon = frames.find(':'); frames.size() > 1)
      options.frames = Interval{std::atof(frames.c_str()), std::atof(frames.c_str() + colon + 1)};
    options.columns = word(4, "");
    options.unit = word(5, "");
    compare_distributions(read_tracks(argv[1], options), std::atoi(word(2, "20").c_str()), word(6, "quick"));
  } catch (const std::exception& e) {
    return fmt::print(stderr, "distributions: {}\n", e.what()), 1;
  }
  return 0;
}
