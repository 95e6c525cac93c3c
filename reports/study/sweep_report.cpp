// SPDX-License-Identifier: MIT
#include "reports/study/sweep_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "libtrack/file.h"
#include "libtrack/nan.h"
#include "reports/comparison/tables.h"
#include "reports/draw/inline_svg.h"
#include "reports/draw/plot.h"
#include "reports/study/measure_figures.h"
#include "reports/study/study_html.h"
#include "reports/study/sweep_figures.h"
#include "reports/write/json_parts.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

using json_parts::finite;
using json_parts::Json;

constexpr std::size_t kMostFigures = 40;

std::map<std::string, int> states_of(const SweepCell& cell) {
  std::map<std::string, int> out;
  for (const SweepRun& run : cell.runs)
    if (!run.state.empty()) ++out[run.state];
  return out;
}

std::map<std::string, int> states_of(const Sweep& s) {
  std::map<std::string, int> out;
  for (const SweepCell& cell : s.cells)
    for (const auto& [state, count] : states_of(cell)) out[state] += count;
  return out;
}

std::int64_t blown_up(const SweepCell& cell) {
  return std::count_if(cell.runs.begin(), cell.runs.end(), [](const SweepRun& run) { return run.blew_up; });
}

struct Ends {
  double lower = INFINITY, upper = -INFINITY;
};

Ends ends_of(const Sweep& s, std::size_t quantity) {
  Ends e;
  for (const SweepCell& cell : s.cells)
    if (const double x = cell.mean[quantity]; std::isfinite(x)) e.lower = std::min(e.lower, x), e.upper = std::max(e.upper, x);
  return e;
}

std::int64_t runs_of(const Sweep& s) {
  std::int64_t out = 0;
  for (const SweepCell& cell : s.cells) out += static_cast<std::int64_t>(cell.runs.size());
  return out;
}

std::string sentence(const Sweep& s) {
  std::int64_t diverged = 0;
  for (const SweepCell& cell : s.cells) diverged += blown_up(cell);
  std::string out =
      fmt::format("{} in {}, {}", s.model, counted(static_cast<std::int64_t>(s.cells.size()), "cell"), counted(runs_of(s), "run"));
  if (diverged > 0) out += fmt::format(", of which {} diverged", counted(diverged));
  return out + '.';
}

std::string unit_of(const Settings& settings) { return setting(settings, "unit"); }

Html cells_table(const Sweep& s, const std::string& unit) {
  HtmlTable table("Cells");
  std::vector<HtmlTable::Cell> head;
  for (const SweepAxis& axis : s.axes) head.push_back(column(axis.name, axis.numeric));
  if (s.hysteresis) head.push_back(column("way"));
  head.push_back(column("state of most runs"));
  head.push_back(column("share", true));
  for (const OrderParameter* p : s.what) {
    const std::string powers = powers_unit(p->length, p->time, unit);
    head.push_back(column(powers.empty() ? std::string(p->name) : fmt::format("{} [{}]", p->name, powers), true));
  }
  table.head(head);
  for (const SweepCell& cell : s.cells) {
    std::vector<HtmlTable::Cell> row;
    for (std::size_t a = 0; a < s.axes.size(); ++a)
      row.push_back(s.axes[a].numeric ? number_cell(cell.words[a]) : text_cell(cell.words[a]));
    if (s.hysteresis) row.push_back(text_cell(cell.down ? "down" : "up"));
    row.push_back(text_cell(state_name(cell.state)));
    row.push_back(number_cell(percent(cell.share)));
    for (const double m : cell.mean) row.push_back(number_cell(in_print(rounded(m))));
    table.row(row);
  }
  return table.sortable().html();
}

std::string sweep_html(const Sweep& s, const Settings& settings, const std::string& version, const std::vector<SweepFigure>& figures) {
  StudyPage page{"sweep", "a model over a range of settings", sentence(s), "", synthetic_badge(), {}, {}, {}, {}, settings, version};
  for (const SweepAxis& axis : s.axes)
    page.facts += fact(axis.name, fmt::format("{} to {}, {} values", axis.words.front(), axis.words.back(), axis.words.size()));
  page.facts += fact("runs per cell", std::to_string(s.seeds));
  for (const char* name : {"agents", "frames", "warm-up", "fps", "dims", "box"}) page.facts += fact(name, setting(settings, name));
  Html drawings;
  for (std::size_t k = 0; k < std::min(figures.size(), kMostFigures); ++k) {
    // Letters alone: names within an SVG begin with them.
    std::string prefix = "f";
    for (std::size_t n = k; n > 0; n /= 26) prefix += static_cast<char>('a' + n % 26);
    Html figure = sheet_of(figures[k].svg, prefix);
    figure += element("figcaption", "", escaped(figures[k].title));
    drawings += element("figure", "", figure);
  }
  if (!drawings.text.empty()) page.sections.push_back({"figures", "Maps and curves", element("div", "grid", drawings)});
  constexpr std::size_t kMostRows = 3000;
  if (s.cells.size() <= kMostRows) page.sections.push_back({"cells", "Cell by cell", cells_table(s, unit_of(settings))});
  page.files = markup("<code>sweep.json</code>, <code>tables/cells.csv</code>, <code>tables/runs.csv</code>");
  return study_html(page);
}

Json cell_json(const Sweep& s, const SweepCell& cell) {
  Json place = Json::object(), quantities = Json::object(), states = Json::object();
  for (std::size_t a = 0; a < s.axes.size(); ++a) place[s.axes[a].name] = s.axes[a].numeric ? Json(cell.place[a]) : Json(cell.words[a]);
  for (std::size_t k = 0; k < s.what.size(); ++k)
    quantities[std::string(s.what[k]->key)] = {{"mean", finite(cell.mean[k])}, {"sd", finite(cell.sd[k])}};
  for (const auto& [state, count] : states_of(cell)) states[state] = count;
  Json out = {{"place", std::move(place)}};
  if (s.hysteresis) out["way"] = cell.down ? "down" : "up";
  out["runs"] = cell.runs.size();
  out["diverged"] = blown_up(cell);
  out["quantities"] = std::move(quantities);
  out["states"] = std::move(states);
  return out;
}

std::string place_csv(const Sweep& s, const SweepCell& cell) {
  std::string out;
  for (std::size_t a = 0; a < s.axes.size(); ++a) out += csv_field(cell.words[a]) + ',';
  return out + (s.hysteresis ? (cell.down ? "down," : "up,") : "");
}

std::string place_head(const Sweep& s) {
  std::string out;
  for (const SweepAxis& axis : s.axes) out += csv_field(axis.name) + ',';
  return out + (s.hysteresis ? "way," : "");
}

}  // namespace

std::string sweep_text(const Sweep& s, TextStyle style) {
  std::string out = paint(wrapped(sentence(s), kTextWidth), Paint::bold, style) + "\n\n";
  constexpr auto l = Align::left, r = Align::right;
  TextTable ranges({l, r, r}, style);
  ranges.row({"mean of a cell", "least", "largest"}, Paint::bold);
  for (std::size_t k = 0; k < s.what.size(); ++k) {
    const Ends e = ends_of(s, k);
    ranges.row({std::string(s.what[k]->name), in_print(rounded(std::isfinite(e.lower) ? e.lower : kNaN)),
                in_print(rounded(std::isfinite(e.upper) ? e.upper : kNaN))});
  }
  TextTable states({l, r}, style);
  states.row({"state at the end", "runs"}, Paint::bold);
  for (const auto& [state, count] : states_of(s)) states.row({state_name(state), counted(count)});
  return finished(out + ranges.text() + '\n' + states.text(), style);
}

std::string to_json(const Sweep& s, const Settings& settings) {
  Json conditions = Json::object(), axes = Json::array(), cells = Json::array();
  for (const auto& [name, value] : settings) conditions[name] = value;
  for (const SweepAxis& axis : s.axes)
    axes.push_back({{"name", axis.name}, {"values", axis.numeric ? Json(axis.value) : Json(axis.words)}});
  for (const SweepCell& cell : s.cells) cells.push_back(cell_json(s, cell));
  const Json all = {{"schema", "swarmfit-sweep/1"},
                    {"conditions", std::move(conditions)},
                    {"model", s.model},
                    {"axes", std::move(axes)},
                    {"cells", std::move(cells)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string cells_csv(const Sweep& s) {
  std::string out = place_head(s) + "runs,diverged";
  for (const OrderParameter* p : s.what) out += fmt::format(",{0},{0}_sd", p->key);
  out += ",state,share";
  const auto states = states_of(s);
  for (const auto& [state, count] : states) out += ",runs_" + state;
  out += '\n';
  for (const SweepCell& cell : s.cells) {
    out += place_csv(s, cell) + fmt::format("{},{}", cell.runs.size(), blown_up(cell));
    for (std::size_t k = 0; k < s.what.size(); ++k) out += fmt::format(",{},{}", exact(cell.mean[k]), exact(cell.sd[k]));
    out += fmt::format(",{},{}", cell.state, exact(cell.share));
    const auto own = states_of(cell);
    for (const auto& [state, count] : states) out += fmt::format(",{}", own.contains(state) ? own.at(state) : 0);
    out += '\n';
  }
  return out;
}

std::string runs_csv(const Sweep& s) {
  std::string out = place_head(s) + "seed,diverged,state";
  for (const OrderParameter* p : s.what) out += fmt::format(",{}", p->key);
  out += '\n';
  for (const SweepCell& cell : s.cells)
    for (const SweepRun& run : cell.runs) {
      out += place_csv(s, cell) + fmt::format("{},{},{}", run.seed, run.blew_up ? 1 : 0, run.state);
      for (const double m : run.means) out += ',' + exact(m);
      out += '\n';
    }
  return out;
}

void write_sweep(const std::string& dir, const Sweep& s, const Settings& settings, const std::string& version) {
  begin_study(dir, "sweep", settings);
  make_directory(dir + "/figures");
  const auto figures = sweep_figures(s, unit_of(settings));
  for (const SweepFigure& figure : figures) write_file_atomically(dir + "/figures/" + figure.name + ".svg", figure.svg);
  write_file_atomically(dir + "/tables/cells.csv", cells_csv(s));
  write_file_atomically(dir + "/tables/runs.csv", runs_csv(s));
  write_file_atomically(dir + "/report.html", sweep_html(s, settings, version, figures));
  write_file_atomically(dir + "/sweep.json", to_json(s, settings));
}

}  // namespace swarmfit
