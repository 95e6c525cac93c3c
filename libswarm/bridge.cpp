// SPDX-License-Identifier: MIT
#include "libswarm/bridge.h"

#include <algorithm>
#include <cmath>

namespace swarmfit {
namespace {

constexpr double kExit = 0.01;    // from the end
constexpr double kEntry = 0.1;    // ants enter up to this far onto the bridge
constexpr double kInside = 0.05;  // of the width
// Beside the sides, for those whose entry would be over them.
constexpr double kLeftEntry = 0.02, kRightEntry = 0.998;  // of the width

// Random numbers of arrivals, apart from those of agents: ids of ants say nothing of the end at which they enter.
constexpr std::uint64_t kArrivals = 0xB21D6E;
enum Draw : std::uint32_t { interval, place, burden, aside };

}  // namespace

void Bridge::advance(const Clock& clock, const World&, State& state) {
  see_off(state);
  welcome(nest_, true, clock, state);
  welcome(food_, false, clock, state);
}

void Bridge::see_off(State& state) const {
  for (Index row = state.size() - 1; row >= 0; --row) {
    const double x = state.pos(row, 0);
    if (state.kind[static_cast<std::size_t>(row)] == 0 ? x > shape_.length - kExit : x < kExit) state.remove(row);
  }
}

void Bridge::welcome(End& end, bool nest, const Clock& clock, State& state) const {
  const Rng rng = clock.rng.derive(Stream::start, kArrivals);
  const std::uint32_t id = nest ? 0 : 1;
  const auto wait = [&] { return -shape_.mean_interval * std::log(1 - rng.uniform(Stream::start, end.arrived, id, interval)); };
  if (end.next < 0) end.next = clock.t + wait();
  for (; end.next <= clock.t; end.next += wait()) {
    const double inwards = kEntry * rng.uniform(Stream::start, end.arrived, id, place);
    double y = 0;
    if (shape_.width > 0) {
      y = shape_.entry_y + shape_.entry_y_spread * rng.normal2(Stream::start, end.arrived, id, aside)[0];
      y = y < 0 ? kLeftEntry * shape_.width : y > shape_.width ? kRightEntry * shape_.width : y;
    }
    const bool laden = rng.uniform(Stream::start, end.arrived, id, burden) < shape_.laden;
    const std::uint8_t kind = nest ? 0 : laden ? 1 : 2;
    state.spawn(kind, {nest ? inwards : shape_.length - inwards, y, 0}, {nest ? shape_.speed : -shape_.speed, 0, 0});
    ++end.arrived;
  }
}

void Bridge::constrain(const World&, const State& before, State& after) const {
  if (shape_.width <= 0) return;
  for (Index row = 0; row < after.size(); ++row) {
    const double y = after.pos(row, 1);
    if (y >= 0 && y <= shape_.width) continue;
    after.pos(row, 0) = before.pos(row, 0);
    after.pos(row, 1) = (y < 0 ? kInside : 1 - kInside) * shape_.width;
  }
}

}  // namespace swarmfit
