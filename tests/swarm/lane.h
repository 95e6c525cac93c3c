// SPDX-License-Identifier: MIT
// What the tests of simulation share: lanes with agents in them, and a sink that remembers frames.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libswarm/noise.h"
#include "libswarm/simulate.h"

namespace swarmfit {

struct Made {
  ModelChoice choice;
  std::unique_ptr<Model> model;
  int dims = 3;
};

// 3, or 2 for models that move in a plane only.
inline int most_dims(std::string_view name) {
  const auto dims = parse_model(name).spec->dims;
  return *std::max_element(dims.begin(), dims.end());
}

// A recording of twenty frames, 0.01 s apart: everybody flies on from where they stand, on springs to the middle of all.
inline Tracks flight_of(const State& state, int dims = 3) {
  TrackColumns columns;
  constexpr Index frames = 20;
  const Index n = state.size();
  columns.pos.resize(frames * n, 3);
  Eigen::Array<double, 1, 3> middle = Eigen::Array<double, 1, 3>::Zero();
  for (Index i = 0; i < n; ++i) middle += state.pos.row(i) / static_cast<double>(n);
  for (Index i = 0; i < n; ++i) columns.names.push_back(std::to_string(i));
  for (Index k = 0; k < frames; ++k) {
    const double t = 0.01 * static_cast<double>(k);
    for (Index i = 0; i < n; ++i) {
      columns.track.push_back(static_cast<std::uint32_t>(i));
      columns.frame.push_back(k);
      columns.pos.row(k * n + i) = middle + std::cos(2 * t) * (state.pos.row(i) - middle) + 0.5 * std::sin(2 * t) * state.vel.row(i);
    }
  }
  TrackMeta meta;
  meta.dims = dims;
  meta.dt = 0.01;
  return {std::move(columns), meta};
}

// What models that learn from a recording are told where a test has none of its own: 60 individuals of speeds about 0.5.
inline const Tracks& any_flight(int dims) {
  static const auto flown = [](int d) {
    State state;
    const Rng rng{5};
    for (std::uint32_t i = 0; i < 60; ++i) {
      const auto xy = rng.uniform2(Stream::start, 0, i, 0);
      const auto zs = rng.uniform2(Stream::start, 0, i, 1);
      state.spawn(0, 3 * Eigen::Array3d(xy[0], xy[1], d == 2 ? 0 : zs[0]),
                  (0.25 + 0.5 * zs[1]) * random_direction(rng, Stream::start, 1, i, 0, d));
    }
    return flight_of(state, d);
  };
  static const Tracks flat = flown(2), solid = flown(3);
  return dims == 2 ? flat : solid;
}

inline Made make(std::string_view name, int dims, const Tracks* reference = nullptr) {
  Made made{parse_model(name), nullptr, dims};
  if (!reference && made.choice.spec->needs_reference) reference = &any_flight(dims);
  made.model = make_model(made.choice, {.dims = dims, .reference = reference});
  return made;
}
inline Made make(std::string_view name) { return make(name, most_dims(name)); }

// Parameters at their scene defaults, agents at random in a box [0, width]^dims with the given speed. dims 0: those of the model.
inline Lane crowd(const Made& made, Index agents, double width, double speed, std::uint64_t seed = 1, int dims = 0) {
  if (dims == 0) dims = made.dims;
  Lane lane;
  lane.rng = {seed};
  lane.world.dims = dims;
  for (const Parameter& p : made.choice.spec->parameters) lane.p.push_back(p.scene.initial);
  for (std::uint32_t i = 0; i < agents; ++i) {
    const auto xy = lane.rng.uniform2(Stream::start, 0, i, 0);
    const double z = dims == 2 ? 0 : lane.rng.uniform(Stream::start, 0, i, 1);
    lane.state.spawn(0, width * Eigen::Array3d(xy[0], xy[1], z), speed * random_direction(lane.rng, Stream::start, 1, i, 0, dims));
  }
  return lane;
}

// A recording of one frame: everybody where they stand.
inline Tracks recording_of(const State& state, int dims = 3) {
  TrackColumns columns;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(state.size()); ++i) {
    columns.names.push_back(std::to_string(i));
    columns.track.push_back(i);
    columns.frame.push_back(0);
  }
  columns.pos = state.pos;
  TrackMeta meta;
  meta.dims = dims;
  meta.dt = 0.01;
  return {std::move(columns), meta};
}

inline void set(const Made& made, Lane& lane, std::string_view parameter, double value) {
  lane.p.at(static_cast<std::size_t>(made.choice.spec->find(parameter))) = value;
}

inline void run(const Made& made, const Plan& plan, Lane& lane) { cpu_backend().run(*made.model, plan, {&lane, 1}); }

struct Recorded : FrameSink {
  struct Moment {
    std::int64_t frame;
    std::vector<std::uint32_t> id;
    Rows pos, vel;
  };
  std::vector<Moment> moments;
  void frame(const Snapshot& now) override { moments.push_back({now.frame, {now.id.begin(), now.id.end()}, now.pos, now.vel}); }
};

}  // namespace swarmfit
