// SPDX-License-Identifier: MIT
#include "libswarm/scenario/read_start.h"

#include <fmt/format.h>

#include <algorithm>

#include "libswarm/centre.h"
#include "libswarm/scenario/surroundings.h"
#include "libtrack/read/read.h"

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Words = std::vector<std::string_view>;

// Individuals of one frame of a recording, with their velocities to the next frame.
void recorded_start(Table& table, Start& start, int dims) {
  const std::string file = table.beside(table.text("file", std::nullopt));
  const Tracks tracks = read_tracks(file);
  const auto frame = table.whole("frame", tracks.frames().front().number);
  if (tracks.dims() > dims) table.refuse("file", fmt::format("has {} dimensions, the scene {}; expected as many", tracks.dims(), dims));
  for (const FrameRange& f : tracks.frames()) {
    if (f.number != frame) continue;
    for (Index row = f.first; row < f.first + f.count; ++row) {
      const Index next = tracks.next()[static_cast<std::size_t>(row)];
      const Array3d place = tracks.pos().row(row).transpose();
      start.points.push_back(place);
      start.velocities.push_back(next < 0 ? Array3d(Array3d::Zero()) : Array3d((tracks.pos().row(next).transpose() - place) / tracks.dt()));
    }
  }
  if (start.points.empty())
    table.refuse("frame", fmt::format("= {} has nobody in {}; expected {} to {}", frame, file, tracks.frames().front().number,
                                      tracks.frames().back().number));
}

void shape_of(Table& table, Start& start, const Scenario& scene) {
  using enum Start::Shape;
  const int dims = scene.dims;
  const Bounds& bounds = scene.bounds;
  static const Words kShapes{"ball", "box", "line", "grid", "ring", "curve", "recorded"};  // as in Start::Shape
  start.shape = static_cast<Start::Shape>(std::find(kShapes.begin(), kShapes.end(), table.choice("shape", "ball")) - kShapes.begin());
  if (start.shape == ball) {
    start.radius = table.number("radius", 0);
    start.centre = table.place("centre", middle_of(bounds), dims);
    if (table.has("centre") && start.radius == 0) table.refuse("centre", "is given without a radius; expected both");
  } else if (start.shape == ring) {
    start.radius = table.number("radius", std::nullopt, kPositive);
    start.centre = table.place("centre", middle_of(bounds), dims);
  } else if (start.shape == curve) {
    if (!scene.curve) table.refuse("shape", "is a curve that is not there; expected [curve]");
    start.points = scene.curve->curve.points;
    start.radius = table.number("radius", scene.curve->reach);
  } else if (start.shape == recorded) {
    recorded_start(table, start, dims);
  } else if (start.shape == line) {
    start.lower = table.place("lower", std::nullopt, dims);
    start.upper = table.place("upper", std::nullopt, dims);
  } else {
    read_corners(table, dims, start.lower, start.upper);
  }
}

}  // namespace

Start read_start(Table table, const Scenario& scene) {
  Start start;
  shape_of(table, start, scene);
  if (start.shape != Start::Shape::recorded) {
    start.speed = table.number("speed", start.speed);
    start.heading = table.place("heading", Array3d::Zero(), scene.dims);
  }
  table.finish();
  return start;
}

}  // namespace swarmfit
