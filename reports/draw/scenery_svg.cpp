// SPDX-License-Identifier: MIT
#include "reports/draw/scenery_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

namespace swarmfit {
namespace {

using Eigen::Array3d;
using Mark = Scenery::Mark;

constexpr int kRound = 48;   // corners of a circle seen aslant
constexpr double kMark = 6;  // half the width of a mark that is a point, on the page

// Something with a depth, so that what is farther is drawn first.
struct Shape {
  double depth;
  std::string svg;
};

std::string outline(const std::vector<SeenPoint>& points, const PageFrame& page) {
  std::string d;
  for (const SeenPoint& p : points)
    d += fmt::format("{}{:.1f} {:.1f}", d.empty() ? "M" : d.find('L') == d.npos ? "L" : " ", page.x(p), page.y(p));
  return d + "z";
}

// Grey, the lighter the more the face looks up the page.
Shape face(const Scenery::Solid& solid, const std::vector<int>& corners, int dims, const PageFrame& page) {
  std::vector<SeenPoint> points;
  SeenPoint sum = SeenPoint::Zero();
  for (const int corner : corners)
    points.push_back(seen_from_aside(solid.corners[static_cast<std::size_t>(corner)], dims)), sum += points.back();
  const SeenPoint a = points[1] - points[0], b = points[2] - points[0];
  const double towards = a[0] * b[1] - a[1] * b[0];  // twice the area that the eye sees; below zero from behind
  if (points.size() < 3 || (dims == 3 && towards <= 0)) return {};
  // Depth grows away from the eye, so that axes are left-handed, and the product points into the body.
  const SeenPoint inwards(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], towards);
  const double size = std::sqrt(inwards.square().sum()), light = dims == 2 || size <= 0 ? 0.5 : 0.5 - 0.5 * inwards[1] / size;
  return {sum[2] / static_cast<double>(points.size()),
          fmt::format("<path class=\"solid\" style=\"fill:hsl(40,6%,{:.0f}%)\" d=\"{}\"/>", 74 + 14 * light, outline(points, page))};
}

std::string ball(const Scenery::Ball& b, int dims, const PageFrame& page, const char* type) {
  const SeenPoint p = seen_from_aside(b.centre, dims);
  return fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", type, page.x(p), page.y(p), b.radius * page.scale);
}

std::string mark(const Mark& m, const Array3d& place, int dims, const PageFrame& page) {
  const SeenPoint p = seen_from_aside(place, dims);
  const double x = page.x(p), y = page.y(p);
  if (m.kind == Mark::Kind::goal)
    return fmt::format("<circle class=\"goal\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>", x, y, m.radius * page.scale);
  if (m.radius > 0) {
    std::vector<SeenPoint> circle;
    for (int k = 0; k < kRound; ++k) {
      const double angle = 2 * std::numbers::pi * k / kRound, along = m.radius * std::cos(angle), across = m.radius * std::sin(angle);
      circle.push_back(seen_from_aside(place + (dims == 3 ? Array3d(along, 0, across) : Array3d(along, across, 0)), dims));
    }
    return fmt::format("<path class=\"ring\" style=\"stroke:{}\" d=\"{}\"/>", colour_of(m.kind), outline(circle, page));
  }
  if (m.kind == Mark::Kind::attract) return fmt::format("<circle class=\"lure\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\"/>", x, y, kMark);
  return fmt::format("<path class=\"threat\" d=\"M{:.1f} {:.1f}l{:g} {:g} {:g} {:g} {:g} {:g}z\"/>", x, y - kMark, kMark, kMark, -kMark,
                     kMark, -kMark, -kMark);
}

}  // namespace

const char* colour_of_kind(int kind) {
  static constexpr std::array kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};
  return kColours[static_cast<std::size_t>(kind) % kColours.size()];
}

const char* colour_of(Mark::Kind kind) {
  return kind == Mark::Kind::attract ? "#009e73" : kind == Mark::Kind::repel ? "#c2185b" : "#7b5ea7";
}

std::string scenery_svg(const Scenery& scenery, std::int64_t frame, int dims, const PageFrame& page) {
  std::vector<Shape> shapes;
  for (const auto& solid : scenery.solids)
    for (const auto& corners : solid.faces)
      if (Shape shape = face(solid, corners, dims, page); !shape.svg.empty()) shapes.push_back(std::move(shape));
  for (const auto& b : scenery.balls) shapes.push_back({seen_from_aside(b.centre, dims)[2], ball(b, dims, page, "solid")});
  std::stable_sort(shapes.begin(), shapes.end(), [](const Shape& a, const Shape& b) { return a.depth > b.depth; });
  std::string out;
  if (scenery.round_arena) out += ball(*scenery.round_arena, dims, page, "arena");
  for (const Shape& shape : shapes) out += shape.svg;
  if (scenery.seen) {
    const Tracks& seen = *scenery.seen;
    for (Index row = 0; row < seen.rows(); ++row) {
      const auto r = static_cast<std::size_t>(row);
      if (seen.frame()[r] != frame) continue;
      const std::string& name = seen.names()[seen.track()[r]];
      std::size_t number = 0;
      std::from_chars(name.data(), name.data() + name.size(), number);
      if (number < scenery.marks.size()) out += mark(scenery.marks[number], seen.pos().row(row).transpose(), dims, page);
    }
  }
  return out.empty() ? out : out + "\n";
}

}  // namespace swarmfit
