// SPDX-License-Identifier: MIT
#include "reports/draw/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace swarmfit::plot {
namespace {

using svg::Anchor;
using svg::length;
using svg::Point;
using svg::Stroke;

constexpr double kTick = 2.5, kSmallTick = 1.4, kGap = 2;
constexpr double kCapHeight = 2.5;  // half the height of a digit
constexpr double kSampleWidth = 17, kAfterSample = 4, kAfterEntry = 10;
constexpr double kWider = 1.12;  // than Helvetica: room for another font

// As in reports/assets/report.css; dashes as there, for thinner lines.
constexpr std::array<std::string_view, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#e69f00", "#56b4e9", "#9a8700", "#4d4d4d"};
constexpr std::array<std::string_view, 8> kDashes = {"",        "4 1.8", "1.2 1.2", "5 1.6 1.2 1.6",
                                                     "2.4 1.2", "7 2.4", "0.8 2",   "4 1.2 0.8 1.2 0.8 1.2"};
constexpr int kShapes = 4, kMarkers = 2 * kShapes;

bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

std::string shape(Point at, int marker) {
  const auto d = [&](std::initializer_list<Point> corners) {
    std::string out;
    for (const Point& p : corners) out += fmt::format("{}{} {}", out.empty() ? "M" : "L", length(at.x + p.x), length(at.y + p.y));
    return out + 'z';
  };
  switch (marker % kShapes) {
    case 1:
      return d({{-1.9, -1.9}, {1.9, -1.9}, {1.9, 1.9}, {-1.9, 1.9}});
    case 2:
      return d({{0, -2.6}, {2.4, 1.7}, {-2.4, 1.7}});
    case 3:
      return d({{0, -2.7}, {2.7, 0}, {0, 2.7}, {-2.7, 0}});
    default:
      return fmt::format("M{0} {1}a2.1 2.1 0 1 0 4.2 0a2.1 2.1 0 1 0 -4.2 0z", length(at.x - 2.1), length(at.y));
  }
}

}  // namespace

Look look(std::size_t series) {
  // Beyond eight the colours return with other dashes.
  const std::size_t colour = series % kColours.size();
  return {kColours[colour], kDashes[(series + series / kColours.size()) % kDashes.size()], static_cast<int>(series % kMarkers)};
}

void draw_marker(svg::Sheet& sheet, Point at, const Look& look, Fill fill) {
  if (!finite(at)) return;
  const bool open = fill == Fill::none || (fill == Fill::of_series && look.marker >= kShapes);
  sheet.path(shape(at, look.marker), {look.colour, 0.8, ""}, open ? std::string_view("#ffffff") : look.colour);
}

Point Panel::place(Point value) const {
  return {box_.left + box_.width * x_.place(value.x), box_.bottom() - box_.height * y_.place(value.y)};
}

std::string Panel::outline(const Curve& curve) const {
  std::string d;
  bool pen = false;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const Point at = place(curve[k]);
    if (!finite(at)) {
      pen = false;
      continue;
    }
    d += fmt::format("{}{} {}", pen ? "L" : "M", length(at.x), length(at.y));
    // A point between two holes would have no extent.
    const bool alone = !pen && (k + 1 == curve.size() || !finite(place(curve[k + 1])));
    if (alone) d += "h0.6";
    pen = true;
  }
  return d;
}

int Panel::clip() {
  if (clip_ == 0) clip_ = sheet_.clip(box_);
  return clip_;
}

void Panel::area(const Curve& curve) {
  Curve closed;
  for (const Point& p : curve)
    if (finite(place(p))) closed.push_back(p);
  if (closed.empty()) return;
  closed.insert(closed.begin(), {closed.front().x, y_.lower});
  closed.push_back({closed.back().x, y_.lower});
  sheet_.path(outline(closed) + 'z', {kRecordingLine, 0.4, ""}, kRecordingFill, clip());
}

void Panel::band(const Curve& lower, const Curve& upper, std::size_t series) {
  between(lower, upper, fmt::format("{}33", look(series).colour));
}
void Panel::grey_band(const Curve& lower, const Curve& upper) { between(lower, upper, std::string(kRecordingFill)); }

void Panel::between(const Curve& lower, const Curve& upper, const std::string& fill) {
  Curve closed;
  for (const Point& p : upper)
    if (finite(place(p))) closed.push_back(p);
  for (auto p = lower.rbegin(); p != lower.rend(); ++p)
    if (finite(place(*p))) closed.push_back(*p);
  if (!closed.empty()) sheet_.path(outline(closed) + 'z', {"none", 0, ""}, fill, clip());
}

void Panel::curve(const Curve& curve, const Stroke& stroke) { sheet_.path(outline(curve), stroke, "none", clip()); }

void Panel::curve(const Curve& points, std::size_t series, double width) {
  curve(points, Stroke{look(series).colour, width, look(series).dash});
}

void Panel::steps(const Curve& points, std::size_t series) {
  Curve stepped;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k > 0 && finite(points[k - 1]) && finite(points[k])) stepped.push_back({points[k].x, points[k - 1].y});
    stepped.push_back(points[k]);
  }
  curve(stepped, series);
}

void Panel::marker(Point at, std::size_t series, Fill fill) { draw_marker(sheet_, place(at), look(series), fill); }

void Panel::across(double y, double from, double to, const Stroke& stroke) {
  const Point a = place({from, y}), b = place({to, y});
  if (finite(a) && finite(b)) sheet_.line(a, b, stroke);
}

void Panel::upright(double x, double from, double to, const Stroke& stroke) {
  const Point a = place({x, from}), b = place({x, to});
  if (finite(a) && finite(b)) sheet_.line(a, b, stroke);
}

void Panel::x_axis(const svg::Text& title) {
  const double y = box_.bottom();
  sheet_.line({box_.left, y}, {box_.right(), y});
  for (const Tick& tick : x_.ticks) {
    const double x = place({tick.value, y_.lower}).x;
    const bool labelled = !tick.label.markup.empty();
    sheet_.line({x, y}, {x, y + (labelled ? kTick : kSmallTick)});
    if (labelled) sheet_.text({x, y + kTick + 1 + svg::kTextSize}, tick.label, Anchor::middle);
  }
  if (!title.markup.empty()) sheet_.text({box_.left + box_.width / 2, y + kTick + 2.5 + 2.15 * svg::kTextSize}, title, Anchor::middle);
}

void Panel::y_ticks() {
  sheet_.line({box_.left, box_.top}, {box_.left, box_.bottom()});
  for (const Tick& tick : y_.ticks) {
    const double y = place({x_.lower, tick.value}).y;
    const bool labelled = !tick.label.markup.empty();
    sheet_.line({box_.left - (labelled ? kTick : kSmallTick), y}, {box_.left, y});
    if (labelled) sheet_.text({box_.left - kTick - kGap, y + kCapHeight}, tick.label, Anchor::end);
  }
}

void Panel::y_axis(const svg::Text& title) {
  y_ticks();
  if (!title.markup.empty()) sheet_.text({box_.left - kTick - kGap, box_.top - 5}, title);
}

double entry_width(const Entry& entry) { return kSampleWidth + kAfterSample + kWider * svg::plain(entry.name).width + kAfterEntry; }

namespace {

void draw_entry(svg::Sheet& sheet, Point at, const Entry& entry) {
  const Look l = look(entry.series);
  const double middle = at.y - kCapHeight;
  if (entry.sample == Sample::area)
    sheet.rectangle({at.x, middle - 2.8, kSampleWidth, 5.6}, kRecordingFill, {kRecordingLine, 0.4, ""});
  else if (entry.sample == Sample::line)
    sheet.line({at.x, middle}, {at.x + kSampleWidth, middle}, {l.colour, 1.1, l.dash});
  else if (entry.sample == Sample::level)
    sheet.line({at.x + 4, middle}, {at.x + kSampleWidth - 4, middle}, {kRecordingLine, 1, ""});
  else
    draw_marker(sheet, {at.x + kSampleWidth / 2, middle}, l);
  sheet.text({at.x + kSampleWidth + kAfterSample, at.y}, svg::plain(entry.name));
}

}  // namespace

void legend_column(svg::Sheet& sheet, Point top, const std::vector<Entry>& entries) {
  for (const Entry& entry : entries) {
    draw_entry(sheet, top, entry);
    top.y += kEntryHeight;
  }
}

double legend_rows(svg::Sheet& sheet, double left, double right, double y, const std::vector<Entry>& entries) {
  double x = left;
  for (const Entry& entry : entries) {
    const double width = entry_width(entry);
    if (x > left && x + width - kAfterEntry > right) x = left, y += kEntryHeight;
    draw_entry(sheet, {x, y}, entry);
    x += width;
  }
  return y + kEntryHeight;
}

}  // namespace swarmfit::plot
