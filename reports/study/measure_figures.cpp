// SPDX-License-Identifier: MIT
#include "reports/study/measure_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libtrack/nan.h"
#include "reports/draw/heat_map.h"
#include "reports/draw/plot.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

constexpr std::size_t kMostPoints = 400;
constexpr double kLeft = 34, kGap = 44, kPanelHeight = 46, kRowHeight = 88, kTop = 20;

std::string titled(std::string_view name, const std::string& unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

// Means over neighbouring frames where there are more than can be seen.
plot::Curve thinned(const TrackMeta& meta, std::span<const std::int64_t> frame, std::span<const double> values) {
  plot::Curve out;
  const std::size_t group = (values.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t k = 0; k < values.size(); k += group) {
    double sum = 0, count = 0;
    const std::size_t end = std::min(values.size(), k + group);
    for (std::size_t i = k; i < end; ++i)
      if (std::isfinite(values[i])) sum += values[i], ++count;
    const double time = meta.t0 + meta.dt * 0.5 * static_cast<double>(frame[k] + frame[end - 1]);
    out.push_back({time, count > 0 ? sum / count : kNaN});
  }
  return out;
}

// Two columns of panels.
svg::Box panel_box(const svg::Sheet& sheet, std::size_t k, double top) {
  const double width = (sheet.width() - 2 * kLeft - kGap / 2) / 2;
  const double left = kLeft + (k % 2 == 0 ? 0 : width + kGap);
  const std::size_t row = k / 2;
  return {left, top + static_cast<double>(row) * kRowHeight, width - kGap / 2, kPanelHeight};
}

plot::Axis axis_over(const std::vector<plot::Curve>& curves, double svg::Point::*part) {
  plot::Range range;
  for (const auto& curve : curves)
    for (const svg::Point& p : curve)
      if (std::isfinite(p.*part)) range.include(p.*part);
  return range.empty() ? plot::linear(0, 1) : plot::linear(range.lower, range.upper, {part == &svg::Point::y ? 3 : 4, 0, false});
}

// The whole curve, and of its band no more than as much again to either side.
plot::Axis axis_with_band(const plot::Curve& middle, const plot::Curve& low, const plot::Curve& high) {
  plot::Range range, band;
  for (const svg::Point& p : middle) range.include(p.y);
  for (const plot::Curve* edge : {&low, &high})
    for (const svg::Point& p : *edge) band.include(p.y);
  if (range.empty() || band.empty()) return axis_over({middle}, &svg::Point::y);
  const double span = range.upper - range.lower, room = span > 0 ? span : INFINITY, least = range.lower - room, most = range.upper + room;
  range.include(std::max(band.lower, least));
  range.include(std::min(band.upper, most));
  return plot::linear(range.lower, range.upper, {3, 0, false});
}

}  // namespace

std::string powers_unit(int length, int time, const std::string& length_unit) { return panel_unit({"", "", length, time}, length_unit); }

std::string series_svg(const TrackMeta& meta, const Measured& measured) {
  if (measured.groups.empty() || measured.groups.front().record.frame().empty()) return {};
  svg::Sheet sheet(svg::kTwoColumns);
  double top = kTop;
  if (measured.groups.size() > 1) {
    std::vector<plot::Entry> entries;
    for (std::size_t g = 0; g < measured.groups.size(); ++g) entries.push_back({plot::Sample::line, g, measured.groups[g].name});
    top = plot::legend_rows(sheet, kLeft, sheet.width(), 9, entries) + kTop;
  }
  const auto& what = measured.groups.front().record.what();
  for (std::size_t k = 0; k < what.size(); ++k) {
    std::vector<plot::Curve> curves;
    for (const MeasuredGroup& g : measured.groups) curves.push_back(thinned(meta, g.record.frame(), g.record.values(k)));
    plot::Panel panel(sheet, panel_box(sheet, k, top), axis_over(curves, &svg::Point::x), axis_over(curves, &svg::Point::y));
    for (std::size_t g = 0; g < curves.size(); ++g) panel.curve(curves[g], g);
    panel.x_axis(svg::plain("time [s]"));
    panel.y_axis(svg::plain(titled(what[k]->name, powers_unit(what[k]->length, what[k]->time, meta.unit))));
  }
  const double height = top + std::ceil(static_cast<double>(what.size()) / 2) * kRowHeight;
  return sheet.document(height, "Order parameters over time", "One panel per order parameter, time along x.");
}

std::string group_curves_svg(const TrackMeta& meta, const MeasuredGroup& group) {
  const auto& curves = group.curves.curves;
  if (curves.empty()) return {};
  svg::Sheet sheet(svg::kTwoColumns);
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const GroupCurve& c = curves[k];
    plot::Curve middle, low, high;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      middle.push_back({c.x[i], c.y[i]});
      if (!std::isfinite(c.se[i])) continue;
      low.push_back({c.x[i], c.y[i] - 2 * c.se[i]});
      high.push_back({c.x[i], c.y[i] + 2 * c.se[i]});
    }
    plot::Panel panel(sheet, panel_box(sheet, k, kTop), axis_over({middle}, &svg::Point::x), axis_with_band(middle, low, high));
    panel.band(low, high, 0);
    panel.curve(middle, 0);
    panel.x_axis(svg::plain(titled(c.x_name, powers_unit(c.x_length, c.x_time, meta.unit))));
    panel.y_axis(svg::plain(titled(c.name, powers_unit(c.y_length, c.y_time, meta.unit))));
  }
  const double height = kTop + std::ceil(static_cast<double>(curves.size()) / 2) * kRowHeight;
  return sheet.document(height, "Curves of the group", "Functions of distance or of time, with bands of two standard errors.");
}

std::string neighbour_map_svg(const TrackMeta& meta, const NeighbourMap& map) {
  if (!(map.counted > 0)) return {};
  svg::Sheet sheet(svg::kOneColumn);
  plot::HeatMap heat;
  for (int k = 0; k < map.side; ++k) heat.x.push_back(map.reach * ((2 * k + 1.0) / map.side - 1));
  heat.y = heat.x;
  heat.value = map.density;
  heat.x_title = titled("left – right", meta.unit);
  heat.y_title = titled("behind – ahead", meta.unit);
  heat.value_title = "density (1 = uniform)";
  plot::draw_heat_map(sheet, {34, 18, 150, 150}, heat);
  return sheet.document(200, "Nearest neighbours around the focal individual",
                        "Ahead is up. Colour: how often a nearest neighbour is there.");
}

}  // namespace swarmfit
