// SPDX-License-Identifier: MIT
// Panels with axes, and what is drawn in them. Values that are not finite are left out: a curve has a hole there.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/draw/axis.h"
#include "reports/draw/svg.h"

namespace swarmfit::plot {

// How one of the compared is drawn everywhere: the report's colours, and a dash and a marker that tell them apart without colour.
struct Look {
  std::string_view colour, dash;
  int marker = 0;  // circle, square, triangle, diamond, and those hollow
};
Look look(std::size_t series);
enum class Fill { of_series, full, none };  // of a marker

inline constexpr std::string_view kRecordingFill = "#d3d7db", kRecordingLine = "#8b949e";

using Curve = std::vector<svg::Point>;  // in units of the axes

// One plot. Draw its contents first and its axes last, so that nothing covers them.
class Panel {
 public:
  Panel(svg::Sheet& sheet, const svg::Box& box, Axis x, Axis y) : sheet_(sheet), box_(box), x_(std::move(x)), y_(std::move(y)) {}

  void area(const Curve& curve);                                          // grey, down to the lower end; cut at the frame
  void band(const Curve& lower, const Curve& upper, std::size_t series);  // pale; between curves over the same x
  void grey_band(const Curve& lower, const Curve& upper);                 // the same of what is drawn in ink
  void curve(const Curve& curve, const svg::Stroke& stroke);
  void curve(const Curve& curve, std::size_t series, double width = 0.9);
  void steps(const Curve& curve, std::size_t series);  // each value holds until the next one
  void marker(svg::Point at, std::size_t series, Fill fill = Fill::of_series);
  void across(double y, double from, double to, const svg::Stroke& stroke);   // a whisker along x, without caps
  void upright(double x, double from, double to, const svg::Stroke& stroke);  // along y

  void x_axis(const svg::Text& title);
  void y_axis(const svg::Text& title);  // the title stands above the axis, where it can be read without turning the page

  svg::Point place(svg::Point value) const;  // on the sheet
  const svg::Box& box() const { return box_; }

 private:
  std::string outline(const Curve& curve) const;
  void between(const Curve& lower, const Curve& upper, const std::string& fill);
  void y_ticks();
  int clip();  // made when it is needed
  svg::Sheet& sheet_;
  svg::Box box_;
  Axis x_, y_;
  int clip_ = 0;
};

// A marker at a place of the sheet.
void draw_marker(svg::Sheet& sheet, svg::Point at, const Look& look, Fill fill = Fill::of_series);

// What stands for what.
enum class Sample { area, line, marker, level };
struct Entry {
  Sample sample = Sample::line;
  std::size_t series = 0;
  std::string name;
};
inline constexpr double kEntryHeight = 9.5;
double entry_width(const Entry& entry);
// One below the other, the first base line at `top`.
void legend_column(svg::Sheet& sheet, svg::Point top, const std::vector<Entry>& entries);
// In rows between left and right, the first base line at y. Returns the base line after the last.
double legend_rows(svg::Sheet& sheet, double left, double right, double y, const std::vector<Entry>& entries);

}  // namespace swarmfit::plot
