// SPDX-License-Identifier: MIT
// Recording and models as curves: over delay, over distance, over time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/comparison/figure_parts.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"

namespace swarmfit::parts {
namespace {

constexpr std::size_t kMost = 8;  // models that can be distinguished in one panel
constexpr double kWidest = 2;     // standard deviations of the band
constexpr double kBeyond = 3;
constexpr const char* kTime = "time from the first frame [s]";
using Values = std::vector<double>;

// Mean or median, and standard deviation or error, of what is drawn.
struct Shown {
  const Values* mean = nullptr;
  const Values* sd = nullptr;  // null: there is none
};

// One panel: what is drawn against what.
struct Wanted {
  std::string x_title, y_title;
  Values x;
  Shown recording;
  std::vector<Shown> models;
  bool logarithmic = false;                   // both axes; what is not positive is left out
  bool cropped = false;                       // models may leave the panel, which reaches kBeyond times the recording's band beyond it
  double least = -INFINITY, most = INFINITY;  // of the values that there can be
};

plot::Curve curve_of(const Wanted& w, const Values& y) {
  plot::Curve out;
  for (std::size_t k = 0; k < std::min(w.x.size(), y.size()); ++k)
    if (!w.logarithmic || (w.x[k] > 0 && y[k] > 0)) out.push_back({w.x[k], y[k]});
  return out;
}

struct Band {
  plot::Curve low, high;  // over the same places
};

Band band_of(const Wanted& w, const Shown& s) {
  Band out;
  for (std::size_t k = 0; s.sd && k < std::min({w.x.size(), s.mean->size(), s.sd->size()}); ++k) {
    const double low = std::max(w.least, (*s.mean)[k] - kWidest * (*s.sd)[k]), high = std::min(w.most, (*s.mean)[k] + kWidest * (*s.sd)[k]);
    if (!std::isfinite(low + high) || (w.logarithmic && !(w.x[k] > 0 && high > 0))) continue;
    out.low.push_back({w.x[k], w.logarithmic ? std::max(low, 0.05 * high) : low});
    out.high.push_back({w.x[k], high});
  }
  return out;
}

// The band of the recording, and what lies near it: what is farther away would leave the axis empty.
plot::Range cropped(const Band& recorded, const std::vector<plot::Curve>& curves) {
  plot::Range band;
  for (const plot::Curve* edge : {&recorded.low, &recorded.high})
    for (const svg::Point& p : *edge) band.include(p.y);
  const double beyond = kBeyond * (band.upper - band.lower);
  plot::Range out = band;
  for (const plot::Curve& curve : curves)
    for (const svg::Point& p : curve)
      if (p.y >= band.lower - beyond && p.y <= band.upper + beyond) out.include(p.y);
  return out;
}

void draw(svg::Sheet& sheet, const svg::Box& box, const Wanted& w) {
  std::vector<plot::Curve> curves{curve_of(w, *w.recording.mean)};
  for (std::size_t k = 0; k < std::min(kMost, w.models.size()); ++k) curves.push_back(curve_of(w, *w.models[k].mean));
  plot::Range across, up;
  for (const plot::Curve& curve : curves)
    for (const svg::Point& p : curve)
      if (std::isfinite(p.y)) across.include(p.x), up.include(p.y);
  if (up.empty()) return;
  const Band recorded = band_of(w, w.recording), best = w.models.empty() ? Band() : band_of(w, w.models.front());
  for (const Band* band : {&recorded, &best})
    for (const plot::Curve* edge : {&band->low, &band->high})
      for (const svg::Point& p : *edge) up.include(p.y);
  if (w.cropped && !recorded.low.empty()) up = cropped(recorded, curves);
  // What hardly varies must not fill the panel with its rounding.
  const double room = std::max(0.05 * (up.upper - up.lower), 1e-3 * std::max(std::abs(up.lower), std::abs(up.upper)));
  const double bottom = std::max(w.least, up.lower - room), top = std::min(w.most, up.upper + room);
  const plot::Axis x =
      w.logarithmic ? plot::logarithmic(across.lower, across.upper) : plot::linear(across.lower, across.upper, {5, box.width, false});
  const plot::Axis y = w.logarithmic ? plot::logarithmic(up.lower, up.upper) : plot::linear(bottom, top, {4, 0, true});
  plot::Panel panel(sheet, box, x, y);
  panel.grey_band(recorded.low, recorded.high);
  panel.band(best.low, best.high, 0);
  for (std::size_t k = curves.size(); k-- > 1;) panel.curve(curves[k], k - 1, k == 1 ? 1.2 : 0.9);
  panel.curve(curves.front(), {svg::kInk, 1.4, ""});
  panel.x_axis(svg::plain(w.x_title));
  panel.y_axis({});
  sheet.text({box.left - 22, box.top - 5}, svg::plain(w.y_title) + plot::in_units(y, ""));
}

// Two panels in a row. The height of the sheet.
double draw_all(svg::Sheet& sheet, const Comparison& c, const std::vector<Wanted>& all, std::size_t across, double plot_height) {
  std::vector<plot::Entry> legend = model_entries(c, plot::Sample::line);
  legend.resize(std::min(kMost, legend.size()));
  const double line = 9;
  sheet.line({4, line - 2.5}, {18, line - 2.5}, {svg::kInk, 1.4, ""});
  sheet.text({21, line}, svg::plain(what_was_seen(c)));
  const double top = plot::legend_rows(sheet, 66, sheet.width(), line, legend) + 12, width = sheet.width() / static_cast<double>(across);
  double bottom = top;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::size_t row = k / across;
    const svg::Box box{static_cast<double>(k % across) * width + 28, top + static_cast<double>(row) * (plot_height + 44), width - 38,
                       plot_height};
    draw(sheet, box, all[k]);
    bottom = std::max(bottom, box.bottom() + 26);
  }
  return bottom;
}

std::string about_band(const Comparison& c) {
  if (c.models.empty()) return {};
  return fmt::format(" Lines: mean of the final replicates of each model. Shaded: {}, mean ± 2 standard deviations of single simulations.",
                     c.models.front().model);
}

// A member of the pictures, with the spread of the models.
Wanted of_pictures(const Comparison& c, Values Pictures::*member, Values x, std::string x_title, std::string y_title,
                   bool logarithmic = false) {
  Wanted out{std::move(x_title), std::move(y_title), std::move(x), {&(c.recording.pictures.recording.*member)}, {}, logarithmic};
  for (const ModelFit& m : c.models) out.models.push_back({&(m.likeness.pictures.mean.*member), &(m.likeness.pictures.sd.*member)});
  return out;
}

Wanted within(Wanted w, double least, double most) {
  w.least = least, w.most = most;
  return w;
}

// A curve of forces, with the standard error of the recording's.
Wanted of_forces(const Comparison& c, Values ForceCurves::*member, Values x, std::string x_title, std::string y_title) {
  const ForceFacts& f = c.recording.forces;
  Wanted out{std::move(x_title), std::move(y_title), std::move(x), {&(f.recording.*member), &(f.se.*member)}, {}};
  out.cropped = true;
  for (const ModelFit& m : c.models) out.models.push_back({&(m.likeness.forces.median.*member)});
  return out;
}

}  // namespace

Figure curves(const Comparison& c) {
  const PictureGrid& g = c.recording.pictures.grid;
  if (c.recording.pictures.recording.vacf.empty()) return {"curves", "", ""};
  std::vector<double> delays, lags, distances;
  for (const Index lag : g.plan.vacf_lags) delays.push_back(static_cast<double>(lag) * g.dt);
  for (const Index lag : g.plan.msd_lags) lags.push_back(static_cast<double>(lag) * g.dt);
  for (std::size_t k = 0; k < c.recording.pictures.recording.pairs.size(); ++k)
    distances.push_back((static_cast<double>(k) + 0.5) * g.width);
  const std::string unit = c.recording.data.unit;
  svg::Sheet sheet(svg::kTwoColumns);
  const double height = draw_all(
      sheet, c,
      {within(of_pictures(c, &Pictures::vacf, delays, "delay [s]", "velocity autocorrelation"), -1, 1),
       of_pictures(c, &Pictures::msd, lags, "delay [s]", fmt::format("mean squared displacement [{}²]", unit), true),
       within(of_pictures(c, &Pictures::pairs, distances, fmt::format("distance [{}]", unit), "pair distribution g(r)"), 0, INFINITY),
       within(of_pictures(c, &Pictures::headings, distances, fmt::format("distance [{}]", unit), "correlation of headings"), -1, 1)},
      2, 92);
  const std::string caption =
      "Velocity autocorrelation and mean squared displacement relative to the group, pair distribution (1 = evenly spread over the "
      "recording's ellipsoid), and mean cosine between headings of pairs at a distance." +
      about_band(c);
  return {"curves", caption, sheet.document(height, "Curves over delay and distance", caption)};
}

Figure forces(const Comparison& c) {
  const ForceFacts& f = c.recording.forces;
  const auto defined = [](const Values& v) { return std::any_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); }); };
  if (!defined(f.recording.drag)) return {"forces", "", ""};
  const std::string unit = c.recording.data.unit;
  std::vector<Wanted> all{of_forces(c, &ForceCurves::drag, f.grid.speeds, fmt::format("speed [{}/s]", unit), "drag [1/s]"),
                          of_forces(c, &ForceCurves::confinement, f.grid.distances, fmt::format("distance from the centre [{}]", unit),
                                    "stiffness of the confinement [1/s²]")};
  if (defined(f.recording.attraction)) {
    const std::string distance = fmt::format("distance of a pair [{}]", unit);
    all.push_back(of_forces(c, &ForceCurves::attraction, f.grid.pairs, distance, fmt::format("attraction of a pair [{}/s²]", unit)));
    all.push_back(of_forces(c, &ForceCurves::alignment, f.grid.pairs, distance, "alignment of a pair [1/s]"));
  }
  svg::Sheet sheet(svg::kTwoColumns);
  const double height = draw_all(sheet, c, all, 2, 92);
  const std::string caption =
      "Forces by regression of accelerations on velocity, position and neighbours, in the recording and, by the same regression, in "
      "simulations of each fitted model. Attraction below 0 is repulsion. Black: recording, with 2 standard errors. Lines: median of eight "
      "simulations each; curves far from the recording are cropped.";
  return {"forces", caption, sheet.document(height, "Forces by regression", caption)};
}

Figure order(const Comparison& c) {
  const PictureGrid& g = c.recording.pictures.grid;
  const Pictures& p = c.recording.pictures.recording;
  if (p.polarisation.empty()) return {"order", "", ""};
  std::vector<double> times;
  for (std::size_t k = 0; k < p.polarisation.size(); ++k)
    times.push_back((static_cast<double>(k) + 0.5) * static_cast<double>(g.stride) * g.dt);
  svg::Sheet sheet(svg::kTwoColumns);
  const double height = draw_all(
      sheet, c,
      {within(of_pictures(c, &Pictures::polarisation, times, kTime, "polarisation"), 0, 1),
       within(of_pictures(c, &Pictures::milling, times, kTime, "milling"), 0, 1),
       within(of_pictures(c, &Pictures::spread, times, kTime, fmt::format("rms radius [{}]", c.recording.data.unit)), 0, INFINITY)},
      3, 70);
  const std::string caption = "Polarisation, milling and spread of the group over time." + about_band(c);
  return {"order", caption, sheet.document(height, "Order of the group over time", caption)};
}

Figure data_quality(const Comparison& c) {
  const Timeline& t = c.recording.pictures.timeline;
  if (t.seen.empty()) return {"data_quality", "", ""};
  const auto curve = [&](const std::vector<double>& y) {
    plot::Curve out;
    for (std::size_t k = 0; k < y.size(); ++k)
      out.push_back({(static_cast<double>(k) + 0.5) * static_cast<double>(t.stride) * c.recording.data.dt, y[k]});
    return out;
  };
  svg::Sheet sheet(svg::kTwoColumns);
  double top = 14;
  const std::vector<std::pair<std::string, const std::vector<double>*>> rows{{"individuals seen per frame", &t.seen},
                                                                             {"individuals lost for a while, per frame", &t.missing},
                                                                             {"steps longer than 20 median steps", &t.jumps}};
  const double end = static_cast<double>(t.seen.size()) * static_cast<double>(t.stride) * c.recording.data.dt;
  for (const auto& [title, values] : rows) {
    const svg::Box box{30, top, sheet.width() - 40, 34};
    const double most = *std::max_element(values->begin(), values->end());
    plot::Panel panel(sheet, box, plot::linear(0, end, {6, box.width, false}), plot::linear(0, most > 0 ? 1.08 * most : 1, {2, 0, false}));
    panel.area(curve(*values));
    panel.curve(curve(*values), {svg::kInk, 0.8, ""});
    panel.x_axis(svg::plain(&title == &rows.back().first ? "time from the first frame [s]" : ""));
    panel.y_axis({});
    sheet.text({4, top - 5}, svg::plain(title));
    top += 34 + (&title == &rows.back().first ? 26 : 30);
  }
  const std::string caption =
      "Quality of the tracks over time: individuals seen, individuals lost for a while (seen before and after), and steps longer than "
      "20 median steps.";
  return {"data_quality", caption, sheet.document(top, "Quality of the tracks over time", caption)};
}

}  // namespace swarmfit::parts
