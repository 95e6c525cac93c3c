// SPDX-License-Identifier: MIT
#include "reports/draw/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr double kWidth = 720, kHeight = 440, kMargin = 28;
constexpr int kBands = 5;            // steps in which a tail fades
constexpr std::int64_t kKnots = 36;  // most points of a tail
constexpr double kPi = std::numbers::pi;

// On the page: to the right, upwards, and away from the eye.
using Point = Eigen::Array3d;

Point seen(const Eigen::Array3d& x, int dims) {
  if (dims == 2) return {x[0], x[1], 0};
  constexpr double azimuth = 30 * kPi / 180, elevation = 25 * kPi / 180;
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation), se = std::sin(elevation);
  return {ca * x[1] - sa * x[0], ce * x[2] - se * (ca * x[0] + sa * x[1]), -(ce * (ca * x[0] + sa * x[1]) + se * x[2])};
}

// Pieces of a path without a gap, oldest point first; the age of a point is its distance from the last frame in frames.
struct Tail {
  struct Knot {
    Point at;
    std::int64_t age;
  };
  std::vector<std::vector<Knot>> pieces;
  Point head = Point::Zero(), before = Point::Zero();
};

Tail tail_of(const Tracks& tracks, std::span<const Index> rows, std::int64_t last, std::int64_t stride) {
  Tail tail;
  const auto point = [&](Index row) { return seen(tracks.pos().row(row).transpose(), tracks.dims()); };
  bool broken = true;
  for (const Index row : rows) {
    const std::int64_t age = last - tracks.frame()[static_cast<std::size_t>(row)];
    const bool ends = tracks.next()[static_cast<std::size_t>(row)] < 0;
    if (broken) tail.pieces.emplace_back();
    if (broken || ends || age % stride == 0) tail.pieces.back().push_back({point(row), age});
    broken = ends;
  }
  tail.head = point(rows.back());
  tail.before = rows.size() > 1 ? point(rows[rows.size() - 2]) : tail.head;
  return tail;
}

// From the plane of projection to the page.
struct Frame {
  double left, top, scale;  // top is the greatest height, since the page counts downwards
  double x(const Point& p) const { return kMargin + (p[0] - left) * scale; }
  double y(const Point& p) const { return kMargin + (top - p[1]) * scale; }
};

Frame fitted(const std::vector<Tail>& tails) {
  Point low = Point::Constant(INFINITY), high = -low;
  for (const Tail& tail : tails)
    for (const auto& piece : tail.pieces)
      for (const auto& knot : piece) low = low.min(knot.at), high = high.max(knot.at);
  const Point size = (high - low).max(1e-9);
  const double across = kWidth - 2 * kMargin, down = kHeight - 2 * kMargin - 16;  // room for the bar
  const double scale = std::min(across / size[0], down / size[1]);
  return {low[0] - 0.5 * (across / scale - size[0]), high[1] + 0.5 * (down / scale - size[1]), scale};
}

// One path per band of age; neighbouring bands share a point so that a tail has no holes.
std::string tail_paths(const Tail& tail, const Frame& frame, std::int64_t longest) {
  std::string out;
  const auto band = [&](std::int64_t age) { return kBands - 1 - std::min<std::int64_t>(kBands - 1, age * kBands / (longest + 1)); };
  for (int b = 0; b < kBands; ++b) {
    std::string d;
    for (const auto& piece : tail.pieces) {
      bool pen = false;
      for (std::size_t k = 0; k + 1 < piece.size(); ++k) {
        const bool drawn = band(piece[k + 1].age) == b;
        if (drawn && !pen) d += fmt::format("M{:.1f} {:.1f}", frame.x(piece[k].at), frame.y(piece[k].at));
        if (drawn) d += fmt::format("{}{:.1f} {:.1f}", pen ? " " : "L", frame.x(piece[k + 1].at), frame.y(piece[k + 1].at));
        pen = drawn;
      }
    }
    if (!d.empty()) out += fmt::format("<path class=\"t{}\" d=\"{}\"/>", b, d);
  }
  return out;
}

std::string arrowhead(const Tail& tail, const Frame& frame, double angle) {
  const double length = 8.5, half = 3.1, x = frame.x(tail.head), y = frame.y(tail.head), c = std::cos(angle), s = -std::sin(angle);
  return fmt::format("<path class=\"h\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f} {:.1f} {:.1f}z\"/>", x + 0.6 * length * c, y + 0.6 * length * s,
                     x - 0.4 * length * c - half * s, y - 0.4 * length * s + half * c, x - 0.4 * length * c + half * s,
                     y - 0.4 * length * s - half * c);
}

// A length of 1, 2 or 5 times a power of ten, about a sixth of the width.
std::string scale_bar(const Frame& frame, const std::string& unit) {
  const double wanted = kWidth / 6 / frame.scale, power = std::pow(10, std::floor(std::log10(wanted)));
  const double length = power * (wanted >= 5 * power ? 5 : wanted >= 2 * power ? 2 : 1);
  const double y = kHeight - 14;
  return fmt::format("<path class=\"bar\" d=\"M{0:.1f} {1:.1f}h{2:.1f}\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\">{5:g} {6}</text>\n", kMargin, y,
                     length * frame.scale, kMargin + length * frame.scale + 8, y + 4, length, unit);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '&' ? std::string("&amp;") : c == '<' ? std::string("&lt;") : std::string(1, c);
  return out;
}

constexpr std::string_view kStyle =
    "<style>path{fill:none;stroke-linejoin:round}.h{fill:currentColor;stroke:#fbfaf7;stroke-width:.6}"
    ".t0,.t1,.t2,.t3,.t4{stroke:currentColor;stroke-width:1.3}.t0{opacity:.07}.t1{opacity:.14}.t2{opacity:.26}.t3{opacity:.42}"
    ".t4{opacity:.62}.bar{stroke:#555;stroke-width:2}text{font:12px sans-serif;fill:#555}</style>\n";

}  // namespace

std::string picture_svg(const Tracks& tracks, const std::string& title) {
  if (tracks.rows() == 0) throw InputError("`picture`: no individuals to draw; expected at least one");
  const std::int64_t last = tracks.frames().back().number, longest = last - tracks.frames().front().number;
  const std::int64_t stride = std::max<std::int64_t>(1, (longest + kKnots - 1) / kKnots);
  std::vector<Tail> tails;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    if (!rows.empty() && tracks.frame()[static_cast<std::size_t>(rows.back())] == last)
      tails.push_back(tail_of(tracks, rows, last, stride));
  }
  std::stable_sort(tails.begin(), tails.end(), [](const Tail& a, const Tail& b) { return a.head[2] > b.head[2]; });
  const double farthest = tails.front().head[2], depth = std::max(farthest - tails.back().head[2], 1e-9);
  const Frame frame = fitted(tails);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" role=\"img\">\n"
      "<title>{2}</title>\n{3}<rect width=\"{0:g}\" height=\"{1:g}\" rx=\"10\" fill=\"#fbfaf7\"/>\n",
      kWidth, kHeight, escaped(title), kStyle);
  for (const Tail& tail : tails) {
    const double angle = std::atan2(tail.head[1] - tail.before[1], tail.head[0] - tail.before[0]);
    const double hue = std::fmod(angle * 180 / kPi + 360 + 210, 360.0), pale = 0.5 + 0.5 * (farthest - tail.head[2]) / depth;
    out += fmt::format("<g color=\"hsl({:.0f},62%,42%)\"{}>{}{}</g>\n", hue,
                       tracks.dims() == 3 ? fmt::format(" opacity=\"{:.2f}\"", pale) : "", tail_paths(tail, frame, longest),
                       arrowhead(tail, frame, angle));
  }
  return out + scale_bar(frame, escaped(tracks.meta().unit)) + "</svg>\n";
}

}  // namespace swarmfit
