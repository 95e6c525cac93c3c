// SPDX-License-Identifier: MIT
// How often and how fast a shepherd brings a flock home, and how ants flow over a bridge: the tables of docs/herds_and_trails.md. By hand:
//   herds_and_trails shepherding [RUNS]     40 runs of every number of sheep and of neighbours: some five minutes of processor time
//   herds_and_trails narrow [RUNS]          60 runs of a bridge where ants queue: some four minutes
//   herds_and_trails wide [RUNS]            60 runs of a bridge where they turn aside, and of one where they stop instead: some five
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "libeval/herding.h"
#include "libswarm/bridge.h"
#include "libtrack/quantile.h"
#include "tests/swarm/lane.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;

struct Spread {
  std::vector<double> values;
  void add(double x) {
    if (std::isfinite(x)) values.push_back(x);
  }
  double median() const { return values.empty() ? NAN : swarmfit::median(values); }
  double mean() const {
    double sum = 0;
    for (const double x : values) sum += x;
    return sum / static_cast<double>(values.size());
  }
  double sd() const {
    double squares = 0;
    for (const double x : values) squares += (x - mean()) * (x - mean());
    return std::sqrt(squares / (static_cast<double>(values.size()) - 1));
  }
};

// ---- shepherding ------------------------------------------------------------------------------------------------------------------

struct Herd {
  int sheep, neighbours;
  double near_speed;
  const char* published;  // success of 40, median steps and share of collecting by an independent implementation
};

constexpr std::array kHerds{
    Herd{20, 5, 0.3, "0, –, 0.93"},   Herd{20, 10, 0.3, "26, 822, 0.55"},  Herd{20, 19, 0.3, "40, 434, 0.23"},
    Herd{50, 12, 0.3, "0, –, 0.78"},  Herd{50, 25, 0.3, "36, 439, 0.30"},  Herd{50, 49, 0.3, "40, 488, 0.19"},
    Herd{100, 25, 0.3, "0, –, 0.45"}, Herd{100, 50, 0.3, "39, 424, 0.21"}, Herd{100, 99, 0.3, "40, 427, 0.13"},
    Herd{20, 19, 0, "40, 427, –"},    Herd{50, 25, 0, "37, 439, –"},
};

constexpr std::int64_t kLongest = 8000, kStretch = 200;  // steps
constexpr double kHome = 10;

// Leaves out the frame at which a stretch begins, which was the last of the one before.
struct Film : FrameSink {
  TrackCollector film;
  std::int64_t last = -1;
  void frame(const Snapshot& now) override {
    if (now.frame <= last) return;
    film.frame(now);
    last = now.frame;
  }
};

// Sheep start in the upper right quarter of a field of side 150, the shepherd in the rest.
Lane pasture(const Made& made, const Herd& herd, std::uint64_t seed) {
  Lane lane = crowd(made, 0, 1, 1);
  lane.rng = {seed};
  set(made, lane, "neighbours", herd.neighbours), set(made, lane, "near_speed", herd.near_speed);
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(herd.sheep); ++i) {
    const auto u = lane.rng.uniform2(Stream::start, 0, i);
    lane.state.spawn(0, 75 * Array3d(1 + u[0], 1 + u[1], 0), random_direction(lane.rng, Stream::start, 1, i, 0, 2));
  }
  Array3d dog = Array3d::Constant(150);
  for (std::uint32_t k = 0; dog[0] > 75 && dog[1] > 75; ++k) {
    const auto u = lane.rng.uniform2(Stream::start, 2, k);
    dog = 150 * Array3d(u[0], u[1], 0);
  }
  lane.state.spawn(1, dog, {1, 0, 0});
  return lane;
}

Herding drive(const Herd& herd, std::uint64_t seed) {
  const Made made = make("shepherding");
  Lane lane = pasture(made, herd, seed);
  Film film;
  lane.out = &film;
  HerdingOptions options;
  options.target = Array3d(Array3d::Zero());
  options.home = kHome;
  // Homecoming may fall between two ends of stretches: whoever came within the distance stays about there, since nothing drives it on.
  for (std::int64_t t = 0; t < kLongest; t += kStretch) {
    run(made, {.frame_dt = 1, .first_frame = t, .frames = kStretch + 1}, lane);
    if (lane.state.pos.topRows(herd.sheep).colwise().mean().square().sum() < kHome * kHome) break;
  }
  TrackMeta meta;
  meta.dims = 2;
  meta.dt = 1;
  return herding(film.film.take(meta), options);
}

void herds(int runs) {
  fmt::print(
      "| N | n | near_speed | home | median steps | collecting | side to side [m] | period [steps] | least autocorrelation | independent "
      "|\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Herd& herd : kHerds) {
    Spread time, collecting, side, period, least;
    for (int k = 1; k <= runs; ++k) {
      const Herding h = drive(herd, static_cast<std::uint64_t>(k));
      time.add(h.time), collecting.add(h.collecting);
      if (!std::isfinite(h.time)) continue;
      side.add(h.side), period.add(h.side_period), least.add(h.side_least);
    }
    fmt::print("| {} | {} | {} | {}/{} | {:.0f} | {:.2f} | {:.1f} | {:.1f} | {:.2f} | {} |\n", herd.sheep, herd.neighbours, herd.near_speed,
               time.values.size(), runs, time.median(), collecting.mean(), side.median(), period.median(), least.median(), herd.published);
    std::fflush(stdout);
  }
}

// ---- ants -------------------------------------------------------------------------------------------------------------------------

enum Ant : std::uint8_t { outbound, laden, unladen };

struct Crossing {
  Ant kind;
  double y;
};

// Who crosses the middle of the bridge, after the first 900 of 4500 s; of those that cross in one step, whoever came from nearer the nest
// first, which is the order in which ants decide.
struct Watch : FrameSink {
  static constexpr double kMiddle = 150;
  std::vector<double> before;  // by id; NaN: not seen yet
  std::vector<Crossing> seen;
  void frame(const Snapshot& now) override {
    std::vector<std::pair<double, Crossing>> crossed;
    for (Index row = 0; row < now.pos.rows(); ++row) {
      const std::size_t k = static_cast<std::size_t>(row), id = now.id[k];
      if (id >= before.size()) before.resize(2 * id + 1, NAN);
      const bool was = before[id] >= kMiddle, is = now.pos(row, 0) >= kMiddle;
      if (now.frame > 9000 && !std::isnan(before[id]) && was != is)
        crossed.push_back({before[id], {static_cast<Ant>(now.kind[k]), now.pos(row, 1)}});
      before[id] = now.pos(row, 0);
    }
    std::sort(crossed.begin(), crossed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [from, crossing] : crossed) seen.push_back(crossing);
  }
};

std::vector<Crossing> crossings(const std::string& bridge, const BridgeShape& shape, std::uint64_t seed) {
  const Made made = make("ant_traffic[bridge=" + bridge + "]");
  Lane lane = crowd(made, 0, 1, 1);
  lane.rng = {seed};
  lane.world.add(std::make_unique<Bridge>(shape));
  Watch watch;
  lane.out = &watch;
  run(made, {.frame_dt = 0.1, .frames = 45000}, lane);
  return watch.seen;
}

using Cluster = std::vector<Ant>;

// Runs of ants in the same direction; the last, unfinished one is left out.
std::vector<Cluster> clusters(const std::vector<Crossing>& seen) {
  std::vector<Cluster> all;
  for (const Crossing& c : seen) {
    if (all.empty() || (all.back().front() == outbound) != (c.kind == outbound)) all.emplace_back();
    all.back().push_back(c.kind);
  }
  if (!all.empty()) all.pop_back();
  return all;
}

// The four flow statistics, over all runs: by size 1 .. 15 and more, the last by place in the cluster, 1 .. 20.
struct Flow {
  static constexpr std::size_t kSizes = 15, kPlaces = 20;
  std::array<double, kSizes> count{}, inbound{}, led{}, ants{}, with_leaf{};
  std::array<double, kPlaces> at{}, at_with_leaf{};
  Spread crossed, size, largest;

  void add(const std::vector<Crossing>& seen) {
    const auto all = clusters(seen);
    double ants_of_all = 0, most = 0;
    for (const Cluster& c : all) {
      const double n = static_cast<double>(c.size());
      const std::size_t bin = std::min(c.size(), kSizes) - 1;
      ants_of_all += n, most = std::max(most, n), count[bin] += 1;
      if (c.front() == outbound) continue;
      inbound[bin] += 1, ants[bin] += n, led[bin] += c.front() == laden;
      for (std::size_t k = 0; k < c.size(); ++k) {
        with_leaf[bin] += c[k] == laden;
        if (k < kPlaces) at[k] += 1, at_with_leaf[k] += c[k] == laden;
      }
    }
    crossed.add(static_cast<double>(seen.size())), size.add(ants_of_all / static_cast<double>(all.size())), largest.add(most);
  }
};

template <std::size_t n>
void row(const char* what, const std::array<double, n>& part, const std::array<double, n>& whole) {
  fmt::print("| {} |", what);
  for (std::size_t k = 0; k < n; ++k) fmt::print(" {:.3f} |", part[k] / whole[k]);
  fmt::print("\n");
}

void narrow(int runs) {
  Flow flow;
  for (int k = 1; k <= runs; ++k) flow.add(crossings("narrow", {}, static_cast<std::uint64_t>(k)));
  fmt::print(
      "narrow bridge, {} runs: crossings {:.0f} ± {:.0f} (independent: 5348 ± 75), mean cluster {:.2f} ± {:.2f} (4.26 ± 0.12), "
      "largest {:.0f} ± {:.0f} (37 ± 7)\n",
      runs, flow.crossed.mean(), flow.crossed.sd(), flow.size.mean(), flow.size.sd(), flow.largest.mean(), flow.largest.sd());
  std::array<double, Flow::kSizes> all{};
  double sum = 0;
  for (const double c : flow.count) sum += c;
  all.fill(sum);
  row("sizes", flow.count, all), row("led by laden", flow.led, flow.inbound), row("laden share", flow.with_leaf, flow.ants);
  row("laden by place", flow.at_with_leaf, flow.at);
}

void wide(const std::string& bridge, int runs) {
  const BridgeShape shape{.width = 5, .mean_interval = 0.8, .laden = 0.04};
  std::array<Spread, 3> inside;
  Flow flow;
  for (int k = 1; k <= runs; ++k) {
    const auto seen = crossings(bridge, shape, static_cast<std::uint64_t>(k));
    flow.add(seen);
    std::array<double, 3> central{}, total{};
    for (const Crossing& c : seen) total[c.kind] += 1, central[c.kind] += c.y >= 1.25 && c.y <= 3.75;
    for (std::size_t kind = 0; kind < 3; ++kind) inside[kind].add(central[kind] / total[kind]);
  }
  fmt::print("| {} | {:.0f} ± {:.0f} | {:.2f} ± {:.2f} |", bridge, flow.crossed.mean(), flow.crossed.sd(), flow.size.mean(),
             flow.size.sd());
  for (const Spread& s : inside) fmt::print(" {:.3f} ± {:.3f} |", s.mean(), s.sd());
  fmt::print("\n");
}

}  // namespace
}  // namespace swarmfit

int main(int argc, char** argv) {
  using namespace swarmfit;
  const std::string what = argc > 1 ? argv[1] : "";
  const int runs = argc > 2 ? std::atoi(argv[2]) : what == "shepherding" ? 40 : 60;
  if (what == "shepherding") return herds(runs), 0;
  if (what == "narrow") return narrow(runs), 0;
  if (what != "wide") return fmt::print(stderr, "herds_and_trails shepherding|narrow|wide [RUNS]\n"), 2;
  fmt::print("| bridge | crossings | mean cluster | outbound | laden | unladen |\n|---|---|---|---|---|---|\n");
  for (const std::string bridge : {"wide", "control"}) wide(bridge, runs);
}
