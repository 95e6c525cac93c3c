// SPDX-License-Identifier: MIT
#include "reports/draw/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "reports/draw/heat_map.h"

namespace swarmfit::plot {
namespace {

constexpr std::size_t kSlices = 12;  // of time, each with its colour
constexpr Index kMostPoints = 5000;  // of all paths
constexpr double kBrightest = 0.92;  // of the colours: the last yellow is lost on white

Window window_around(const std::vector<const Tracks*>& all) {
  Eigen::Array2d low(INFINITY, INFINITY), high(-INFINITY, -INFINITY);
  for (const Tracks* t : all) {
    if (t->rows() == 0) continue;
    low = low.min(t->pos().leftCols(2).colwise().minCoeff().transpose());
    high = high.max(t->pos().leftCols(2).colwise().maxCoeff().transpose());
  }
  Window out;
  if (!std::isfinite(low.sum() + high.sum())) return out;
  out.x = 0.5 * (low[0] + high[0]), out.y = 0.5 * (low[1] + high[1]);
  const double half = 0.5 * (high - low).maxCoeff();
  out.half = half > 0 ? 1.02 * half : 1;
  return out;
}

// A square that holds both.
Window holding(const Window& a, const Window& b) {
  const double left = std::min(a.x - a.half, b.x - b.half), right = std::max(a.x + a.half, b.x + b.half);
  const double low = std::min(a.y - a.half, b.y - b.half), high = std::max(a.y + a.half, b.y + b.half);
  return {0.5 * (left + right), 0.5 * (low + high), 0.5 * std::max(right - left, high - low)};
}

// Points of the sheet per length unit.
double scale_of(const svg::Box& box, const Window& window) { return 0.5 * std::min(box.width, box.height) / window.half; }

}  // namespace

Window window_of(const Tracks& tracks) { return window_around({&tracks}); }

Window window_for(const std::vector<const Tracks*>& all) {
  constexpr double kMost = 2;  // beyond, the recording itself would be too small to see
  const Window first = window_of(*all.front()), whole = holding(window_around(all), first);
  return whole.half <= kMost * first.half ? whole : Window{first.x, first.y, kMost * first.half};
}

double share_outside(const Tracks& tracks, const Window& window) {
  const auto x = (tracks.pos().col(0) - window.x).abs(), y = (tracks.pos().col(1) - window.y).abs();
  return tracks.rows() == 0 ? 0 : static_cast<double>((x.max(y) > window.half).count()) / static_cast<double>(tracks.rows());
}

void draw_window(svg::Sheet& sheet, const svg::Box& box, const Window& shown, const Window& window) {
  const double scale = scale_of(box, window), side = 2 * scale * shown.half;
  sheet.rectangle({box.left + box.width / 2 + scale * (shown.x - window.x) - side / 2,
                   box.top + box.height / 2 - scale * (shown.y - window.y) - side / 2, side, side},
                  "none", {svg::kSoft, 0.5, "2 2"});
}

void draw_paths(svg::Sheet& sheet, const svg::Box& box, const Tracks& tracks, const Window& window) {
  if (tracks.frames().empty()) return;
  const std::int64_t first = tracks.frames().front().number, frames = tracks.frames().back().number - first + 1;
  const auto every = static_cast<std::size_t>(std::max<Index>(1, (tracks.rows() + kMostPoints - 1) / kMostPoints));
  const double scale = scale_of(box, window);
  std::array<std::string, kSlices> paths;
  for_each_segment(tracks, 2, [&](std::span<const Index> rows) {
    svg::Point before{};
    std::size_t slice_before = kSlices;
    for (std::size_t k = 0; k < rows.size(); k += every) {
      const Index row = rows[k];
      const svg::Point at{box.left + box.width / 2 + scale * (tracks.pos()(row, 0) - window.x),
                          box.top + box.height / 2 - scale * (tracks.pos()(row, 1) - window.y)};
      const std::int64_t passed = tracks.frame()[static_cast<std::size_t>(row)] - first;
      const auto slice = std::min(kSlices - 1, static_cast<std::size_t>(passed * static_cast<std::int64_t>(kSlices) / frames));
      if (k > 0) {
        if (slice != slice_before) paths[slice] += fmt::format("M{:.1f} {:.1f}", before.x, before.y);
        paths[slice] += fmt::format("L{:.1f} {:.1f}", at.x, at.y);
        slice_before = slice;
      }
      before = at;
    }
  });
  const int clip = sheet.clip(box);
  for (std::size_t k = 0; k < kSlices; ++k) {
    const std::string colour = heat_colour(kBrightest * static_cast<double>(k) / (kSlices - 1));
    sheet.path(paths[k], {colour, 0.5, ""}, "none", clip);
  }
  sheet.rectangle(box, "none", {svg::kFaint, 0.5, ""});
}

}  // namespace swarmfit::plot
