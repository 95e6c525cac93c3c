// SPDX-License-Identifier: MIT
#include "reports/study/measure_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "libtrack/file.h"
#include "reports/comparison/tables.h"
#include "reports/study/measure_figures.h"
#include "reports/study/measure_html.h"
#include "reports/write/json_parts.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

using json_parts::finite;
using json_parts::Json;

constexpr std::size_t kMostSpells = 12;

Json numbers(const std::vector<double>& values) {
  Json out = Json::array();
  for (const double x : values) out.push_back(finite(x));
  return out;
}

std::string heading(const MeasuredGroup& g, const TrackMeta& meta) {
  return fmt::format("{}: linked within {}{}, states over windows of {} frames", printable(g.name), rounded(g.link),
                     meta.unit.empty() ? "" : ' ' + printable(meta.unit), g.window);
}

std::string means_text(const MeasuredGroup& g, const TrackMeta& meta, TextStyle style) {
  constexpr auto l = Align::left, r = Align::right;
  TextTable table({l, r, l, r, l}, style);
  table.row({"", "mean", "95 % interval", "sd", "unit"}, Paint::bold);
  for (std::size_t k = 0; k < g.means.size(); ++k) {
    const OrderParameter& p = *g.record.what()[k];
    const SeriesMean& m = g.means[k];
    const std::string interval = std::isfinite(m.lower) ? in_print(rounded(m.lower) + " .. " + rounded(m.upper)) : kUndefined;
    table.row({std::string(p.name), in_print(rounded(m.mean)), interval, in_print(rounded(m.sd)),
               printable(powers_unit(p.length, p.time, meta.unit))});
  }
  return table.text();
}

std::string states_text(const MeasuredGroup& g, const TrackMeta& meta) {
  std::vector<std::string> lines;
  for (const StateSpell& s : spells(g.states)) {
    if (lines.size() == kMostSpells) {
      lines.emplace_back("...");
      break;
    }
    lines.push_back(fmt::format("{} to {} s: {}", brief(meta.t0 + meta.dt * static_cast<double>(s.first)),
                                brief(meta.t0 + meta.dt * static_cast<double>(s.last)), s.state->name));
  }
  std::string out;
  for (const std::string& line : lines) out += "   " + line + '\n';
  std::size_t fissions = 0;
  for (const GroupEvent& e : g.states.events) fissions += e.fission();
  if (!g.states.events.empty())
    out += fmt::format("   {}, {}\n", counted(static_cast<std::int64_t>(fissions), "fission"),
                       counted(static_cast<std::int64_t>(g.states.events.size() - fissions), "fusion"));
  return out;
}

Json means_json(const MeasuredGroup& g, const TrackMeta& meta) {
  Json out = Json::object();
  for (std::size_t k = 0; k < g.means.size(); ++k) {
    const OrderParameter& p = *g.record.what()[k];
    const SeriesMean& m = g.means[k];
    out[std::string(p.key)] = {{"mean", finite(m.mean)}, {"interval", {finite(m.lower), finite(m.upper)}},
                               {"sd", finite(m.sd)},     {"unit", powers_unit(p.length, p.time, meta.unit)},
                               {"frames", m.count},      {"correlation_time", finite(m.correlation_time * meta.dt)},
                               {"blocks", m.blocks}};
  }
  return out;
}

Json curves_json(const MeasuredGroup& g) {
  Json out = Json::object();
  for (const GroupCurve& c : g.curves.curves) out[c.key] = {{"x", numbers(c.x)}, {"y", numbers(c.y)}, {"se", numbers(c.se)}};
  return out;
}

Json states_json(const MeasuredGroup& g) {
  Json windows = Json::array(), events = Json::array();
  for (const StateWindow& w : g.states.windows)
    windows.push_back({{"first_frame", w.first}, {"last_frame", w.last}, {"state", w.state->key}});
  for (const GroupEvent& e : g.states.events)
    events.push_back(
        {{"frame", e.frame}, {"event", e.fission() ? "fission" : "fusion"}, {"parts_before", e.before}, {"parts_after", e.after}});
  return {{"window", g.window}, {"windows", std::move(windows)}, {"events", std::move(events)}};
}

Json group_json(const MeasuredGroup& g, const TrackMeta& meta) {
  Json out = {{"name", g.name}, {"link", finite(g.link)}, {"means", means_json(g, meta)}};
  out["states"] = states_json(g);
  out["correlation_length"] = {{"value", finite(g.curves.correlation_length)}, {"se", finite(g.curves.correlation_length_se)}};
  out["neighbour_map"] = {{"ahead", finite(g.curves.map.ahead)},
                          {"left", finite(g.curves.map.left)},
                          {"side", g.curves.map.side},
                          {"reach", finite(g.curves.map.reach)},
                          {"density", numbers(g.curves.map.density)}};
  out["curves"] = curves_json(g);
  return out;
}

// A name of a group as part of a file's name: letters, digits, and "_" for anything else.
std::string group_part(const std::string& name) {
  std::string out;
  for (const char c : name) out += (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? c : '_';
  return out.substr(0, 60);
}

std::string curve_csv(const GroupCurve& c) {
  std::string out = fmt::format("{},{},se\n", c.x_length == 0 ? "time" : c.x_time == 0 ? "distance" : "speed", c.key);
  for (std::size_t k = 0; k < c.x.size(); ++k) out += fmt::format("{},{},{}\n", exact(c.x[k]), exact(c.y[k]), exact(c.se[k]));
  return out;
}

void write_group(const std::string& dir, std::size_t number, const TrackMeta& meta, const MeasuredGroup& g) {
  const std::string tail = number == 0 ? "" : fmt::format("_{}_{}", number, group_part(g.name));
  write_file_atomically(dir + "/tables/series" + tail + ".csv", series_csv(meta, g));
  for (const GroupCurve& c : g.curves.curves) write_file_atomically(fmt::format("{}/tables/{}{}.csv", dir, c.key, tail), curve_csv(c));
}

void write_figure(const std::string& dir, const std::string& name, const std::string& svg) {
  if (!svg.empty()) write_file_atomically(dir + "/figures/" + name + ".svg", svg);
}

}  // namespace

std::string measure_text(const TrackMeta& meta, const Measured& measured, TextStyle style) {
  std::string out;
  for (const MeasuredGroup& g : measured.groups) {
    if (!out.empty()) out += '\n';
    out += paint(wrapped(heading(g, meta), kTextWidth), Paint::bold, style) + "\n";
    out += means_text(g, meta, style);
    if (std::isfinite(g.curves.correlation_length))
      out += wrapped(fmt::format(" correlation length of velocity fluctuations {} {}, standard error {}",
                                 rounded(g.curves.correlation_length), printable(meta.unit), rounded(g.curves.correlation_length_se)),
                     kTextWidth, " ") +
             '\n';
    out += states_text(g, meta);
  }
  out += wrapped("\nIntervals are of the mean over time, from blocks of two correlation times or more; a dash: too short for four of them.",
                 kTextWidth);
  return finished(out + '\n', style);
}

std::string to_json(const TrackMeta& meta, const Measured& measured, const Settings& settings) {
  Json conditions = Json::object(), groups = Json::array();
  for (const auto& [name, value] : settings) conditions[name] = value;
  for (const MeasuredGroup& g : measured.groups) groups.push_back(group_json(g, meta));
  const Json all = {{"schema", "swarmfit-measure/1"},
                    {"conditions", std::move(conditions)},
                    {"sha256", meta.from.sha256},
                    {"dims", meta.dims},
                    {"dt", meta.dt},
                    {"unit", meta.unit},
                    {"groups", std::move(groups)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string series_csv(const TrackMeta& meta, const MeasuredGroup& g) {
  std::string out = "frame,time";
  for (const OrderParameter* p : g.record.what()) out += fmt::format(",{}", p->key);
  out += '\n';
  for (std::size_t f = 0; f < g.record.frame().size(); ++f) {
    out += fmt::format("{},{}", g.record.frame()[f], exact(meta.t0 + meta.dt * static_cast<double>(g.record.frame()[f])));
    for (std::size_t k = 0; k < g.record.what().size(); ++k) out += ',' + exact(g.record.values(k)[f]);
    out += '\n';
  }
  return out;
}

std::string means_csv(const TrackMeta& meta, const Measured& measured) {
  std::string out = "group,quantity,unit,mean,lower,upper,sd,frames,correlation_time,blocks\n";
  for (const MeasuredGroup& g : measured.groups)
    for (std::size_t k = 0; k < g.means.size(); ++k) {
      const OrderParameter& p = *g.record.what()[k];
      const SeriesMean& m = g.means[k];
      out +=
          fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_field(g.name), p.key, csv_field(powers_unit(p.length, p.time, meta.unit)),
                      exact(m.mean), exact(m.lower), exact(m.upper), exact(m.sd), m.count, exact(m.correlation_time * meta.dt), m.blocks);
    }
  return out;
}

std::string states_csv(const TrackMeta& meta, const Measured& measured) {
  std::string out = "group,first_frame,last_frame,first_time,last_time,state,parts,largest,polarisation,net_rotation,rotation,axis_ratio\n";
  for (const MeasuredGroup& g : measured.groups)
    for (const StateWindow& w : g.states.windows)
      out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(g.name), w.first, w.last,
                         exact(meta.t0 + meta.dt * static_cast<double>(w.first)), exact(meta.t0 + meta.dt * static_cast<double>(w.last)),
                         w.state->key, exact(w.features.parts), exact(w.features.largest), exact(w.features.polarisation),
                         exact(w.features.net_rotation), exact(w.features.rotation), exact(w.features.axis_ratio));
  return out;
}

std::string events_csv(const TrackMeta& meta, const Measured& measured) {
  std::string out = "group,frame,time,event,parts_before,parts_after\n";
  for (const MeasuredGroup& g : measured.groups)
    for (const GroupEvent& e : g.states.events)
      out += fmt::format("{},{},{},{},{},{}\n", csv_field(g.name), e.frame, exact(meta.t0 + meta.dt * static_cast<double>(e.frame)),
                         e.fission() ? "fission" : "fusion", e.before, e.after);
  return out;
}

void write_measured(const std::string& dir, const TrackMeta& meta, const Measured& measured, const Settings& settings,
                    const std::string& version) {
  begin_study(dir, "measure", settings);
  make_directory(dir + "/figures");
  for (std::size_t k = 0; k < measured.groups.size(); ++k) write_group(dir, k, meta, measured.groups[k]);
  write_file_atomically(dir + "/tables/means.csv", means_csv(meta, measured));
  write_file_atomically(dir + "/tables/states.csv", states_csv(meta, measured));
  write_file_atomically(dir + "/tables/events.csv", events_csv(meta, measured));
  write_figure(dir, "series", series_svg(meta, measured));
  write_figure(dir, "curves", group_curves_svg(meta, measured.groups.front()));
  write_figure(dir, "neighbours", neighbour_map_svg(meta, measured.groups.front().curves.map));
  write_file_atomically(dir + "/report.html", measure_html(meta, measured, settings, version));
  write_file_atomically(dir + "/measure.json", to_json(meta, measured, settings));
}

}  // namespace swarmfit
