// SPDX-License-Identifier: MIT
#include "reports/draw/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/draw/plot.h"
#include "reports/write/number.h"

namespace swarmfit::plot {
namespace {

using svg::Box;

constexpr std::string_view kUndefinedFill = "#c9cfd5";
constexpr std::array<std::array<int, 3>, 9> kViridis{{{68, 1, 84},
                                                      {71, 44, 122},
                                                      {59, 81, 139},
                                                      {44, 113, 142},
                                                      {33, 144, 141},
                                                      {39, 173, 129},
                                                      {92, 200, 99},
                                                      {170, 220, 50},
                                                      {253, 231, 37}}};
constexpr double kBarWidth = 8, kBarGap = 8;

// Where cells begin and end along an axis: half-way between centres.
std::vector<double> edges(const std::vector<double>& centres, bool log) {
  const auto to = [&](double v) { return log ? std::log(v) : v; };
  const auto back = [&](double v) { return log ? std::exp(v) : v; };
  const std::size_t n = centres.size();
  std::vector<double> out(n + 1);
  for (std::size_t k = 1; k < n; ++k) out[k] = back(0.5 * (to(centres[k - 1]) + to(centres[k])));
  const double first = n > 1 ? 0.5 * (to(centres[1]) - to(centres[0])) : 0.5,
               last = n > 1 ? 0.5 * (to(centres[n - 1]) - to(centres[n - 2])) : 0.5;
  out[0] = back(to(centres[0]) - first);
  out[n] = back(to(centres[n - 1]) + last);
  return out;
}

Axis axis_of(const std::vector<double>& ends, bool log) {
  return log ? logarithmic(ends.front(), ends.back()) : linear(ends.front(), ends.back(), {5, 0, false});
}

// The cells' rectangles, filled as `fill` says, then the axes.
template <class Fill>
void draw_cells(svg::Sheet& sheet, const Box& box, const std::vector<double>& x, const std::vector<double>& y, std::array<bool, 2> log,
                const std::vector<std::string>& label, const std::array<std::string_view, 2>& titles, const Fill& fill) {
  const auto xs = edges(x, log[0]), ys = edges(y, log[1]);
  Axis across = axis_of(xs, log[0]), up = axis_of(ys, log[1]);
  across.lower = xs.front(), across.upper = xs.back();
  up.lower = ys.front(), up.upper = ys.back();
  for (Axis* axis : {&across, &up})
    std::erase_if(axis->ticks, [&](const Tick& tick) { return tick.value < axis->lower || tick.value > axis->upper; });
  Panel panel(sheet, box, across, up);
  for (std::size_t row = 0; row < y.size(); ++row)
    for (std::size_t column = 0; column < x.size(); ++column) {
      const svg::Point a = panel.place({xs[column], ys[row + 1]}), b = panel.place({xs[column + 1], ys[row]});
      const std::size_t cell = row * x.size() + column;
      // A hair wider, so that no light shines through between neighbours.
      sheet.rectangle({a.x, a.y, b.x - a.x + 0.2, b.y - a.y + 0.2}, fill(cell), {"none", 0, ""}, label.empty() ? "" : label[cell]);
    }
  panel.x_axis(svg::plain(titles[0]));
  panel.y_axis(svg::plain(titles[1]));
}

}  // namespace

std::string heat_colour(double share) {
  if (!std::isfinite(share)) return std::string(kUndefinedFill);
  const double at = std::clamp(share, 0.0, 1.0) * (kViridis.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), kViridis.size() - 2);
  std::array<int, 3> c{};
  for (std::size_t i = 0; i < 3; ++i)
    c[i] = static_cast<int>(std::lround(kViridis[k][i] + (at - static_cast<double>(k)) * (kViridis[k + 1][i] - kViridis[k][i])));
  return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

void draw_heat_map(svg::Sheet& sheet, const Box& box, const HeatMap& map) {
  Range range;
  for (const double v : map.value)
    if (std::isfinite(v)) range.include(v);
  if (map.lower < map.upper) range.lower = map.lower, range.upper = map.upper;
  if (range.lower == range.upper) range.lower -= 0.5, range.upper += 0.5;  // in the middle of the colours
  const double low = range.empty() ? 0 : range.lower, high = range.empty() ? 1 : range.upper;
  const auto share = [&](double v) { return (v - low) / (high - low); };
  draw_cells(sheet, box, map.x, map.y, {map.x_log, map.y_log}, map.label, {map.x_title, map.y_title},
             [&](std::size_t cell) { return heat_colour(share(map.value[cell])); });
  constexpr int kSteps = 40;
  const double left = box.right() + kBarGap, step = box.height / kSteps;
  for (int k = 0; k < kSteps; ++k)
    sheet.rectangle({left, box.bottom() - (k + 1) * step, kBarWidth, step + 0.2}, heat_colour((k + 0.5) / kSteps), {"none", 0, ""});
  const Axis bar = linear(low, high, {4, 0, false});
  for (const Tick& tick : bar.ticks) {
    if (tick.value < low || tick.value > high || tick.label.markup.empty()) continue;
    const double y = box.bottom() - box.height * share(tick.value);
    sheet.line({left + kBarWidth, y}, {left + kBarWidth + 2, y});
    sheet.text({left + kBarWidth + 4, y + 2.5}, tick.label);
  }
  sheet.text({left + kBarWidth, box.top - 5}, svg::plain(map.value_title), svg::Anchor::end);
}

void draw_name_map(svg::Sheet& sheet, const Box& box, const NameMap& map) {
  draw_cells(sheet, box, map.x, map.y, {map.x_log, map.y_log}, map.label, {map.x_title, map.y_title}, [&](std::size_t cell) {
    if (map.value[cell] < 0) return std::string(kUndefinedFill);
    // Opacity in the last two digits: half of it where only half agree.
    const int opacity = static_cast<int>(std::lround(255 * std::clamp(map.share[cell], 0.25, 1.0)));
    return fmt::format("{}{:02x}", look(static_cast<std::size_t>(map.value[cell])).colour, opacity);
  });
  double x = box.left, y = box.bottom() + 32;
  for (std::size_t k = 0; k < map.names.size(); ++k) {
    const double width = 11 + 1.12 * svg::plain(map.names[k]).width + 9;
    if (x > box.left && x + width > sheet.width()) x = box.left, y += kEntryHeight;
    sheet.rectangle({x, y - 6, 7, 7}, look(k).colour, {"none", 0, ""});
    sheet.text({x + 11, y}, svg::plain(map.names[k]));
    x += width;
  }
}

}  // namespace swarmfit::plot
