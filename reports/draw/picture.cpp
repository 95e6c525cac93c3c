// SPDX-License-Identifier: MIT
#include "reports/draw/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "libtrack/error.h"
#include "reports/draw/projection.h"
#include "reports/draw/scenery_svg.h"

namespace swarmfit {
namespace {

constexpr double kWidth = 720, kHeight = 440, kMargin = 28;
constexpr int kBands = 5;            // steps in which a tail fades
constexpr std::int64_t kKnots = 36;  // most points of a tail
constexpr double kPi = std::numbers::pi;

// Pieces of a path without a gap, oldest point first; the age of a point is its distance from the last frame in frames.
struct Tail {
  struct Knot {
    SeenPoint at;
    std::int64_t age;
  };
  std::vector<std::vector<Knot>> pieces;
  SeenPoint head = SeenPoint::Zero(), before = SeenPoint::Zero();
  int kind = 0;
};

Tail tail_of(const Tracks& tracks, std::span<const Index> rows, std::int64_t last, std::int64_t stride) {
  Tail tail;
  const auto point = [&](Index row) { return seen_from_aside(tracks.pos().row(row).transpose(), tracks.dims()); };
  bool broken = true;
  for (const Index row : rows) {
    const std::int64_t age = last - tracks.frame()[static_cast<std::size_t>(row)];
    const bool ends = tracks.next()[static_cast<std::size_t>(row)] < 0;
    if (broken) tail.pieces.emplace_back();
    if (broken || ends || age % stride == 0) tail.pieces.back().push_back({point(row), age});
    broken = ends;
  }
  tail.kind = tracks.kind(rows.back());
  tail.head = point(rows.back());
  tail.before = rows.size() > 1 ? point(rows[rows.size() - 2]) : tail.head;
  return tail;
}

PageFrame fitted(const std::vector<Tail>& tails, const Scenery& scenery, int dims) {
  SeenPoint low = SeenPoint::Constant(INFINITY), high = -low;
  const auto hold = [&](const SeenPoint& p) { low = low.min(p), high = high.max(p); };
  for (const Tail& tail : tails)
    for (const auto& piece : tail.pieces)
      for (const auto& knot : piece) hold(knot.at);
  for (int corner = 0; scenery.box && corner < 8; ++corner) {
    const auto& [lower, upper] = *scenery.box;
    hold(seen_from_aside(
        {(corner & 1) != 0 ? upper[0] : lower[0], (corner & 2) != 0 ? upper[1] : lower[1], (corner & 4) != 0 ? upper[2] : lower[2]}, dims));
  }
  const SeenPoint size = (high - low).max(1e-9);
  const double across = kWidth - 2 * kMargin, down = kHeight - 2 * kMargin - 16;  // room for the bar
  const double scale = std::min(across / size[0], down / size[1]);
  return {kMargin, low[0] - 0.5 * (across / scale - size[0]), high[1] + 0.5 * (down / scale - size[1]), scale};
}

// One path per band of age; neighbouring bands share a point so that a tail has no holes.
std::string tail_paths(const Tail& tail, const PageFrame& frame, std::int64_t longest) {
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

std::string arrowhead(const Tail& tail, const PageFrame& frame, double angle) {
  const double length = 8.5, half = 3.1, x = frame.x(tail.head), y = frame.y(tail.head), c = std::cos(angle), s = -std::sin(angle);
  return fmt::format("<path class=\"h\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f} {:.1f} {:.1f}z\"/>", x + 0.6 * length * c, y + 0.6 * length * s,
                     x - 0.4 * length * c - half * s, y - 0.4 * length * s + half * c, x - 0.4 * length * c + half * s,
                     y - 0.4 * length * s - half * c);
}

// A length of 1, 2 or 5 times a power of ten, about a sixth of the width.
std::string scale_bar(const PageFrame& frame, const std::string& unit) {
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
    ".t4{opacity:.62}.bar{stroke:#555;stroke-width:2}text{font:12px sans-serif;fill:#555}";
// Of what only some pictures have.
constexpr std::string_view kSceneryStyle =
    ".solid{fill:#cfccc5;stroke:#a9a59c;stroke-width:.7}.arena{fill:none;stroke:#c9c5bb}.goal{fill:#7b5ea7;fill-opacity:.12;stroke:#7b5ea7;"
    "stroke-dasharray:5 3;stroke-width:1.4}.ring{stroke-dasharray:2 3;stroke-width:1.4}.lure{fill:#009e73;stroke:#fbfaf7}"
    ".threat{fill:#c2185b;stroke:#fbfaf7}";

// What a picture shows besides individuals that are all alike: its sign and what it is called.
std::string key_of(const Tracks& tracks, const Scenery& scenery) {
  std::vector<std::pair<std::string, std::string>> entries;
  const auto& names = tracks.meta().kinds;
  for (int k = 0; tracks.kinds() > 1 && k < tracks.kinds(); ++k)
    entries.emplace_back(colour_of_kind(k),
                         static_cast<std::size_t>(k) < names.size() ? names[static_cast<std::size_t>(k)] : fmt::format("kind {}", k));
  using enum Scenery::Mark::Kind;
  const std::pair<Scenery::Mark::Kind, const char*> signs[] = {{attract, "attracts"}, {repel, "repels"}, {goal, "goal"}};
  for (const auto& sign : signs)
    if (std::any_of(scenery.marks.begin(), scenery.marks.end(), [&](const auto& m) { return m.kind == sign.first; }))
      entries.emplace_back(colour_of(sign.first), sign.second);
  std::string out;
  double x = kWidth - kMargin;
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    x -= 7.0 * static_cast<double>(entry->second.size()) + 22;
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/><text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x,
                       kHeight - 14, entry->first, x + 8, kHeight - 10, escaped(entry->second));
  }
  return out;
}

std::vector<Tail> tails_of(const Tracks& tracks, std::int64_t first, std::int64_t last) {
  const std::int64_t stride = std::max<std::int64_t>(1, (last - first + kKnots - 1) / kKnots);
  std::vector<Tail> tails;
  for (std::uint32_t t = 0; t < tracks.track_count(); ++t) {
    const auto rows = tracks.rows_of(t);
    if (!rows.empty() && tracks.frame()[static_cast<std::size_t>(rows.back())] == last)
      tails.push_back(tail_of(tracks, rows, last, stride));
  }
  std::stable_sort(tails.begin(), tails.end(), [](const Tail& a, const Tail& b) { return a.head[2] > b.head[2]; });
  return tails;
}

std::string begin_picture(const std::string& title, bool bare) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" role=\"img\">\n"
      "<title>{2}</title>\n{3}{4}</style>\n<rect width=\"{0:g}\" height=\"{1:g}\" rx=\"10\" fill=\"#fbfaf7\"/>\n",
      kWidth, kHeight, escaped(title), kStyle, bare ? std::string_view() : kSceneryStyle);
}

}  // namespace

std::string picture_svg(const Tracks& tracks, const std::string& title, const Scenery& scenery) {
  if (tracks.rows() == 0) throw InputError("`picture`: no individuals to draw; expected at least one");
  const std::int64_t last = tracks.frames().back().number, first = tracks.frames().front().number;
  const std::vector<Tail> tails = tails_of(tracks, first, last);
  const double farthest = tails.front().head[2], depth = std::max(farthest - tails.back().head[2], 1e-9);
  const bool bare =
      scenery.marks.empty() && scenery.balls.empty() && scenery.solids.empty();  // and an arena without anything shows nothing
  const PageFrame frame = fitted(tails, bare ? Scenery() : scenery, tracks.dims());
  std::string out = begin_picture(title, bare) + scenery_svg(scenery, last, tracks.dims(), frame);
  const bool by_kind = tracks.kinds() > 1;
  for (const Tail& tail : tails) {
    const double angle = std::atan2(tail.head[1] - tail.before[1], tail.head[0] - tail.before[0]);
    const double hue = std::fmod(angle * 180 / kPi + 360 + 210, 360.0), pale = 0.5 + 0.5 * (farthest - tail.head[2]) / depth;
    out += fmt::format("<g color=\"{}\"{}>{}{}</g>\n", by_kind ? colour_of_kind(tail.kind) : fmt::format("hsl({:.0f},62%,42%)", hue),
                       tracks.dims() == 3 ? fmt::format(" opacity=\"{:.2f}\"", pale) : "", tail_paths(tail, frame, last - first),
                       arrowhead(tail, frame, angle));
  }
  return out + scale_bar(frame, escaped(tracks.meta().unit)) + key_of(tracks, scenery) + "</svg>\n";
}

}  // namespace swarmfit
