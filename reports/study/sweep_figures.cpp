// SPDX-License-Identifier: MIT
#include "reports/study/sweep_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/draw/heat_map.h"
#include "reports/draw/plot.h"
#include "reports/study/measure_figures.h"
#include "reports/write/number.h"

namespace swarmfit {
namespace {

constexpr std::size_t kMostSlices = 12, kMostSeries = 8;
const svg::Box kBox{42, 20, 170, 150};

std::string titled(const OrderParameter& p, const std::string& unit) {
  const std::string powers = powers_unit(p.length, p.time, unit);
  return powers.empty() ? std::string(p.name) : fmt::format("{} [{}]", p.name, powers);
}

// A word of the user's as part of a file's name.
std::string file_part(const std::string& word) {
  std::string out;
  for (const char c : word) out += (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '.' ? c : '_';
  return out.substr(0, 40);
}

// The part of a sweep with one value of the third axis, on one way.
struct Slice {
  std::vector<const SweepCell*> cells;  // first axis fastest
  std::string tail, words;              // for names of files, and titles
};

std::vector<Slice> slices(const Sweep& s, bool down) {
  const std::size_t size = s.axes[0].value.size() * (s.axes.size() > 1 ? s.axes[1].value.size() : 1);
  std::vector<Slice> out;
  for (const SweepCell& cell : s.cells) {
    if (cell.down != down) continue;
    if (out.empty() || out.back().cells.size() == size) {
      if (out.size() == kMostSlices) break;
      Slice next;
      if (s.axes.size() > 2) next.tail = fmt::format("_{}_{}", file_part(s.axes[2].name), file_part(cell.words[2]));
      if (s.axes.size() > 2) next.words = fmt::format(", {} = {}", s.axes[2].name, cell.words[2]);
      if (s.hysteresis) next.tail += down ? "_down" : "_up", next.words += down ? ", on the way down" : ", on the way up";
      out.push_back(std::move(next));
    }
    out.back().cells.push_back(&cell);
  }
  return out;
}

std::string place_words(const Sweep& s, const SweepCell& cell) {
  std::string out;
  for (std::size_t a = 0; a < s.axes.size(); ++a) out += fmt::format("{}{} = {}", a == 0 ? "" : ", ", s.axes[a].name, cell.words[a]);
  return out;
}

template <class Map>
Map map_of(const Sweep& s, const Slice& slice) {
  Map map;
  map.x = s.axes[0].value, map.y = s.axes[1].value;
  map.x_log = s.axes[0].log, map.y_log = s.axes[1].log;
  map.x_title = s.axes[0].name, map.y_title = s.axes[1].name;
  for (const SweepCell* cell : slice.cells) map.label.push_back(place_words(s, *cell));
  return map;
}

SweepFigure heat_figure(const Sweep& s, const Slice& slice, std::size_t quantity, const std::string& unit) {
  auto map = map_of<plot::HeatMap>(s, slice);
  for (std::size_t k = 0; k < slice.cells.size(); ++k) {
    const SweepCell& cell = *slice.cells[k];
    map.value.push_back(cell.mean[quantity]);
    map.label[k] += fmt::format(": {}, sd {}", rounded(cell.mean[quantity]), rounded(cell.sd[quantity]));
  }
  map.value_title = titled(*s.what[quantity], unit);
  svg::Sheet sheet(svg::kOneColumn);
  plot::draw_heat_map(sheet, {kBox.left, kBox.top, 150, kBox.height}, map);
  const std::string title = fmt::format("{}: mean over {} runs{}", s.what[quantity]->name, s.seeds, slice.words);
  return {fmt::format("map_{}{}", s.what[quantity]->key, slice.tail), title,
          sheet.document(kBox.bottom() + 32, title, "A cell per pair of values.")};
}

SweepFigure state_figure(const Sweep& s, const Slice& slice) {
  auto map = map_of<plot::NameMap>(s, slice);
  std::vector<std::string> keys;
  for (const SweepCell& cell : s.cells)  // the same colours in all slices
    if (!cell.state.empty() && std::find(keys.begin(), keys.end(), cell.state) == keys.end()) keys.push_back(cell.state);
  std::sort(keys.begin(), keys.end());
  for (const std::string& key : keys) map.names.push_back(state_name(key));
  for (std::size_t k = 0; k < slice.cells.size(); ++k) {
    const SweepCell& cell = *slice.cells[k];
    const auto at = std::find(keys.begin(), keys.end(), cell.state);
    map.value.push_back(at == keys.end() ? -1 : static_cast<int>(at - keys.begin()));
    map.share.push_back(cell.share);
    map.label[k] += fmt::format(": {} in {} of the runs", state_name(cell.state), percent(cell.share));
  }
  svg::Sheet sheet(svg::kOneColumn);
  plot::draw_name_map(sheet, {kBox.left, kBox.top, 180, kBox.height}, map);
  const std::string title = fmt::format("State of most of {} runs{}; paler where fewer agree", s.seeds, slice.words);
  return {"map_states" + slice.tail, title, sheet.document(kBox.bottom() + 62, title, "A cell per pair of values.")};
}

// One curve: cells along the first axis.
struct Branch {
  std::vector<const SweepCell*> cells;
  std::string name;
};

std::vector<Branch> branches(const Sweep& s, const std::vector<Slice>& parts) {
  std::vector<Branch> out;
  const std::size_t length = s.axes[0].value.size();
  for (const Slice& slice : parts)
    for (std::size_t k = 0; k + length <= slice.cells.size(); k += length) {
      Branch b;
      b.cells.assign(slice.cells.begin() + static_cast<std::ptrdiff_t>(k), slice.cells.begin() + static_cast<std::ptrdiff_t>(k + length));
      if (s.axes.size() > 1) b.name = fmt::format("{} = {}", s.axes[1].name, b.cells.front()->words[1]);
      if (s.hysteresis) b.name += fmt::format("{}{}", b.name.empty() ? "" : ", ", b.cells.front()->down ? "down" : "up");
      out.push_back(std::move(b));
    }
  if (out.size() <= kMostSeries) return out;
  // As many as can be told apart, evenly chosen, the ends among them.
  std::vector<Branch> few;
  for (std::size_t k = 0; k < kMostSeries; ++k) few.push_back(out[k * (out.size() - 1) / (kMostSeries - 1)]);
  return few;
}

SweepFigure curve_figure(const Sweep& s, const std::vector<Branch>& all, std::size_t quantity, const std::string& unit,
                         const std::string& tail) {
  svg::Sheet sheet(svg::kOneColumn);
  plot::Range x, y;
  for (const Branch& b : all)
    for (const SweepCell* cell : b.cells) {
      x.include(cell->place[0]);
      for (const double side : {-1.0, 0.0, 1.0})
        if (const double v = cell->mean[quantity] + (side == 0 ? 0 : side * cell->sd[quantity]); std::isfinite(v)) y.include(v);
    }
  if (y.empty()) y.include(0), y.include(1);
  const plot::Axis across = s.axes[0].log ? plot::logarithmic(x.lower, x.upper) : plot::linear(x.lower, x.upper);
  plot::Panel panel(sheet, {kBox.left, kBox.top, 185, 130}, across, plot::linear(y.lower, y.upper));
  std::vector<plot::Entry> entries;
  for (std::size_t k = 0; k < all.size(); ++k) {
    plot::Curve middle, low, high;
    for (const SweepCell* cell : all[k].cells) {
      const double at = cell->place[0], m = cell->mean[quantity], sd = cell->sd[quantity];
      middle.push_back({at, m}), low.push_back({at, m - sd}), high.push_back({at, m + sd});
    }
    panel.band(low, high, k);
    panel.curve(middle, k);
    entries.push_back({plot::Sample::line, k, all[k].name});
  }
  panel.x_axis(svg::plain(s.axes[0].name));
  panel.y_axis(svg::plain(titled(*s.what[quantity], unit)));
  double height = kBox.top + 130 + 34;
  if (!entries.front().name.empty()) height = plot::legend_rows(sheet, kBox.left, sheet.width(), height, entries);
  const std::string title =
      fmt::format("{} against {}: mean and standard deviation over {} runs", s.what[quantity]->name, s.axes[0].name, s.seeds);
  return {fmt::format("curve_{}{}", s.what[quantity]->key, tail), title,
          sheet.document(height, title, "A curve per value of the other axis.")};
}

SweepFigure cloud_figure(const Sweep& s, std::size_t a, std::size_t b, std::size_t quantity, const std::string& unit) {
  plot::Range x, y, v;
  for (const SweepCell& cell : s.cells) {
    x.include(cell.place[a]), y.include(cell.place[b]);
    if (std::isfinite(cell.mean[quantity])) v.include(cell.mean[quantity]);
  }
  const auto axis = [&](const plot::Range& r, std::size_t k) {
    return s.axes[k].log ? plot::logarithmic(r.lower, r.upper) : plot::linear(r.lower, r.upper);
  };
  svg::Sheet sheet(svg::kOneColumn);
  plot::Panel panel(sheet, {kBox.left, kBox.top, 185, 150}, axis(x, a), axis(y, b));
  for (const SweepCell& cell : s.cells) {
    const svg::Point at = panel.place({cell.place[a], cell.place[b]});
    const double m = cell.mean[quantity], share = v.empty() || v.upper <= v.lower ? 0.5 : (m - v.lower) / (v.upper - v.lower);
    sheet.rectangle({at.x - 2.5, at.y - 2.5, 5, 5}, plot::heat_colour(share), {"none", 0, ""},
                    fmt::format("{}: {}", place_words(s, cell), rounded(m)));
  }
  panel.x_axis(svg::plain(s.axes[a].name));
  panel.y_axis(svg::plain(s.axes[b].name));
  const std::string title =
      fmt::format("{}, from {} (dark) to {} (light)", titled(*s.what[quantity], unit), rounded(v.lower), rounded(v.upper));
  return {fmt::format("cloud_{}_{}_{}", s.what[quantity]->key, file_part(s.axes[a].name), file_part(s.axes[b].name)), title,
          sheet.document(kBox.bottom() + 32, title, "A point per set of values.")};
}

}  // namespace

std::vector<SweepFigure> sweep_figures(const Sweep& s, const std::string& unit) {
  std::vector<SweepFigure> out;
  if (s.latin) {
    for (std::size_t q = 0; q < s.what.size(); ++q)
      for (std::size_t a = 0; a < s.axes.size(); ++a)
        for (std::size_t b = a + 1; b < s.axes.size(); ++b) out.push_back(cloud_figure(s, a, b, q, unit));
    return out;
  }
  auto ways = slices(s, false);
  if (s.hysteresis)
    for (Slice& slice : slices(s, true)) ways.push_back(std::move(slice));
  if (s.axes.size() > 1)
    for (const Slice& slice : ways) {
      out.push_back(state_figure(s, slice));
      for (std::size_t q = 0; q < s.what.size(); ++q) out.push_back(heat_figure(s, slice, q, unit));
    }
  if (!s.axes[0].numeric || s.axes[0].value.size() < 2) return out;
  // Curves of every value of the third axis by themselves, both ways together.
  std::map<std::string, std::vector<Slice>> by_third;
  for (const Slice& slice : ways) by_third[s.axes.size() > 2 ? slice.cells.front()->words[2] : ""].push_back(slice);
  for (const auto& [third, parts] : by_third)
    for (std::size_t q = 0; q < s.what.size(); ++q)
      out.push_back(curve_figure(s, branches(s, parts), q, unit,
                                 third.empty() ? "" : fmt::format("_{}_{}", file_part(s.axes[2].name), file_part(third))));
  return out;
}

}  // namespace swarmfit
