// SPDX-License-Identifier: MIT
#include "reports/draw/square_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/draw/axis.h"
#include "reports/draw/heat_map.h"

namespace swarmfit::plot {
namespace {

constexpr int kLevels = 16;
constexpr std::string_view kNothing = "#e3e5e8";

// Blue and orange of Okabe and Ito (2008) at the ends, nearly white between.
std::string diverging_colour(double share) {
  using Rgb = std::array<double, 3>;
  constexpr Rgb kBelow{0, 114, 178}, kMiddle{247, 247, 247}, kAbove{213, 94, 0};
  const double at = 2 * std::clamp(share, 0.0, 1.0) - 1;
  const Rgb& end = at < 0 ? kBelow : kAbove;
  std::array<int, 3> c{};
  for (std::size_t i = 0; i < 3; ++i) c[i] = static_cast<int>(std::lround(kMiddle[i] + std::abs(at) * (end[i] - kMiddle[i])));
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string colour(const MapScale& scale, int level) {
  const double share = (level + 0.5) / kLevels;
  return scale.scheme == Scheme::diverging ? diverging_colour(share) : heat_colour(share);
}

int level_of(const MapScale& scale, double value) {
  const double share = (value - scale.lower) / (scale.upper - scale.lower);
  return std::clamp(static_cast<int>(std::floor(share * kLevels)), 0, kLevels - 1);
}

}  // namespace

void draw_square_map(svg::Sheet& sheet, const svg::Box& box, const std::vector<double>& value, std::size_t side, const MapScale& scale) {
  sheet.rectangle(box, kNothing, {"none", 0, ""});
  if (value.size() < side * side || !(scale.lower < scale.upper)) return;
  std::array<std::string, kLevels> paths;
  const double w = box.width / static_cast<double>(side), h = box.height / static_cast<double>(side);
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t column = 0; column < side;) {
      const double v = value[row * side + column];
      std::size_t end = column + 1;
      if (!std::isfinite(v)) {
        column = end;
        continue;
      }
      const int level = level_of(scale, v);
      while (end < side && std::isfinite(value[row * side + end]) && level_of(scale, value[row * side + end]) == level) ++end;
      // A hair wider, so that no light shines through between neighbours.
      paths[static_cast<std::size_t>(level)] +=
          fmt::format("M{:.1f} {:.1f}h{:.1f}v{:.1f}h{:.1f}z", box.left + static_cast<double>(column) * w,
                      box.bottom() - static_cast<double>(row + 1) * h, static_cast<double>(end - column) * w + 0.1, h + 0.1,
                      -static_cast<double>(end - column) * w - 0.1);
      column = end;
    }
  for (int level = 0; level < kLevels; ++level)
    if (const std::string& d = paths[static_cast<std::size_t>(level)]; !d.empty()) sheet.path(d, {"none", 0, ""}, colour(scale, level));
}

void draw_colour_bar(svg::Sheet& sheet, const svg::Box& box, const MapScale& scale, const std::string& title) {
  const double step = box.height / kLevels;
  for (int k = 0; k < kLevels; ++k)
    sheet.rectangle({box.left, box.bottom() - (k + 1) * step, box.width, step + 0.1}, colour(scale, k), {"none", 0, ""});
  for (const Tick& tick : linear(scale.lower, scale.upper, {3, 0, false}).ticks) {
    if (tick.value < scale.lower || tick.value > scale.upper || tick.label.markup.empty()) continue;
    const double y = box.bottom() - box.height * (tick.value - scale.lower) / (scale.upper - scale.lower);
    sheet.line({box.right(), y}, {box.right() + 2, y});
    sheet.text({box.right() + 4, y + 2.5}, tick.label);
  }
  sheet.text({box.right(), box.top - 5}, svg::plain(title), svg::Anchor::end);
}

}  // namespace swarmfit::plot
