// SPDX-License-Identifier: MIT
#include "reports/comparison/across_report.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "libtrack/file.h"
#include "reports/comparison/tables.h"
#include "reports/comparison/words.h"
#include "reports/write/json_parts.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;
using json_parts::Json;

std::string place(const ModelAcross& m, std::size_t recording) {
  if (m.rank[recording] == 0) return kUndefined;
  return fmt::format("{} ({})", m.rank[recording], fixed(m.score[recording], 3));
}

// "0.412 (0.105 .. 0.719)"; an en dash for the first.
std::string lead_text(const MeanOverRecordings& lead) {
  if (!std::isfinite(lead.mean)) return kUndefined;
  const std::string mean = fixed(lead.mean, 3);
  return std::isfinite(lead.lower) ? fmt::format("{} ({} .. {})", mean, fixed(lead.lower, 3), fixed(lead.upper, 3)) : mean;
}

Json by_column(const Across& a, const PerColumn<double>& values) {
  Json out = Json::object();
  for (std::size_t j = 0; j < a.columns.size(); ++j) out[a.columns[j].key()] = values[j];
  return out;
}

Json interval(const MeanOverRecordings& of) { return std::isfinite(of.lower) ? Json::array({of.lower, of.upper}) : Json(nullptr); }

PaperTable ranking(const Across& a) {
  PaperTable t{"across_ranking",
               "Rank and, in brackets, score of every model on every recording; models by mean rank. Lead of the first: with its 95 % "
               "interval over recordings.",
               {"model"},
               {}};
  for (const auto& name : a.recordings) t.head.push_back(fs::path(name).filename().string());
  t.head.insert(t.head.end(), {"mean rank", "mean score", "first", "lead of the first"});
  for (const ModelAcross& m : a.models) {
    std::vector<std::string> row{m.model};
    for (std::size_t k = 0; k < a.recordings.size(); ++k) row.push_back(place(m, k));
    row.insert(row.end(), {fixed(m.mean_rank, 2), fixed(m.mean_score, 3), std::to_string(m.wins), in_print(lead_text(m.lead))});
    t.rows.push_back(std::move(row));
  }
  return t;
}

PaperTable weights(const Across& a) {
  PaperTable t{"across_weights", "Entropy weights of the metrics on every recording.", {"recording"}, {}};
  for (const Column& column : a.columns) t.head.push_back(column.symbol());
  const auto add = [&](const std::string& name, const PerColumn<double>& values) {
    std::vector<std::string> row{name};
    for (const double w : values) row.push_back(fixed(w, 4));
    t.rows.push_back(std::move(row));
  };
  for (std::size_t k = 0; k < a.recordings.size(); ++k) add(a.recordings[k], a.weights[k]);
  add("mean", a.mean_weight);
  return t;
}

}  // namespace

std::string across_text(const Across& a, TextStyle style) {
  std::vector<Align> align = {Align::left};
  align.insert(align.end(), a.recordings.size() + 3, Align::right);
  TextTable t(align, style);
  std::vector<std::string> head = {"model"};
  for (const auto& name : a.recordings) head.push_back(printable(fs::path(name).stem().string()));
  head.insert(head.end(), {"mean rank", "first", "lead of the first"});
  t.row(head, Paint::bold);
  for (const ModelAcross& m : a.models) {
    std::vector<std::string> row{m.model};
    for (std::size_t k = 0; k < a.recordings.size(); ++k) row.push_back(place(m, k));
    row.insert(row.end(), {fixed(m.mean_rank, 2), std::to_string(m.wins), lead_text(m.lead)});
    t.row(row, &m == &a.models.front() ? Paint::good : Paint::plain);
  }
  const std::string out = fmt::format("Rank (score) on {} recordings\n{}", a.recordings.size(), t.text());
  return style.unicode ? out : ascii(out);
}

std::string to_json(const Across& a) {
  Json models = Json::array(), recordings = Json::array();
  for (std::size_t k = 0; k < a.recordings.size(); ++k)
    recordings.push_back({{"path", a.recordings[k]}, {"weights", by_column(a, a.weights[k])}});
  for (const ModelAcross& m : a.models)
    models.push_back({{"name", m.model},
                      {"rank", m.rank},
                      {"score", m.score},
                      {"mean_rank", m.mean_rank},
                      {"mean_score", m.mean_score},
                      {"first", m.wins},
                      {"lead_of_first", m.lead.mean},
                      {"lead_ci", interval(m.lead)}});
  const Json all = {{"schema", "swarmfit-across/1"},
                    {"recordings", std::move(recordings)},
                    {"mean_weights", by_column(a, a.mean_weight)},
                    {"smallest_weights", by_column(a, a.smallest_weight)},
                    {"largest_weights", by_column(a, a.largest_weight)},
                    {"models", std::move(models)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string across_csv(const Across& a) {
  std::string out = "model,recording,rank,score\n";
  for (const ModelAcross& m : a.models)
    for (std::size_t k = 0; k < a.recordings.size(); ++k)
      out += fmt::format("{},{},{},{}\n", csv_field(m.model), csv_field(a.recordings[k]), m.rank[k] > 0 ? std::to_string(m.rank[k]) : "",
                         exact(m.score[k]));
  return out;
}

std::vector<PaperTable> paper_tables(const Across& a) { return {ranking(a), weights(a)}; }

void write_across(const std::string& dir, const Across& a, const std::vector<RecordingPage>& pages, const std::string& version) {
  const fs::path root = dir, tables = root / "tables";
  make_directory(tables.string());
  std::error_code no_such_file;
  fs::remove(root / "summary.json", no_such_file);
  write_file_atomically((tables / "across.csv").string(), across_csv(a));
  for (const PaperTable& t : paper_tables(a)) write_table(tables.string(), t);
  write_file_atomically((root / "report.html").string(), across_html(a, pages, version));
  write_file_atomically((root / "summary.json").string(), to_json(a));
}

}  // namespace swarmfit
