// SPDX-License-Identifier: MIT
#include "reports/study/recovery_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "libtrack/file.h"
#include "reports/comparison/tables.h"
#include "reports/study/recovery_counts.h"
#include "reports/study/recovery_html.h"
#include "reports/write/json_parts.h"
#include "reports/write/number.h"

namespace swarmfit {
namespace {

using json_parts::Json;

std::string count_text(int n) { return n > 0 ? std::to_string(n) : "·"; }

std::vector<std::string> confusion_row(const Recovery& r, std::size_t p) {
  std::vector<std::string> row{r.planted[p]};
  for (const int n : r.confusion[p]) row.push_back(count_text(n));
  row.push_back(fmt::format("{} of {}", counts_of::recovered(r, p), counts_of::recordings(r, p)));
  return row;
}

Json parameters(const std::vector<PlantedRow>& rows, const std::vector<double>& values) {
  Json out = Json::object();
  for (std::size_t k = 0; k < values.size(); ++k)
    if (rows[k].used) out[rows[k].name] = values[k];
  return out;
}

}  // namespace

std::string table_text(const PaperTable& table, TextStyle style) {
  std::vector<Align> align(table.head.size(), Align::right);
  align.front() = Align::left;
  TextTable t(align, style);
  t.row(table.head, Paint::bold);
  for (const auto& row : table.rows) t.row(row);
  return finished(t.width() > kTextWidth ? t.folded() : t.text(), style);
}

PaperTable confusion_table(const Recovery& r, const std::string& caption) {
  PaperTable t{"confusion", caption, {"true model \\ ranked first"}, {}};
  t.head.insert(t.head.end(), r.compared.begin(), r.compared.end());
  t.head.emplace_back("recovered");
  for (std::size_t p = 0; p < r.planted.size(); ++p) t.rows.push_back(confusion_row(r, p));
  return t;
}

PaperTable confidence_table(const Recovery& r, const std::string& caption) {
  PaperTable t{"confidence", caption, {"true model \\ in the best group"}, {}};
  t.head.insert(t.head.end(), r.compared.begin(), r.compared.end());
  t.head.emplace_back("rejected");
  for (std::size_t p = 0; p < r.planted.size(); ++p) {
    t.rows.push_back({r.planted[p]});
    for (const auto& model : r.compared) t.rows.back().push_back(count_text(counts_of::in_best_group(r, p, model)));
    t.rows.back().push_back(fmt::format("{} of {}", counts_of::rejected(r, p, r.planted[p]), counts_of::recordings(r, p)));
  }
  return t;
}

std::string recovery_text(const Recovery& r, TextStyle style) {
  return table_text(confusion_table(r, ""), style) + '\n' + table_text(confidence_table(r, ""), style);
}

std::string recovery_csv(const Recovery& r) {
  std::string out = "true_model,seed,rank,model,score,score_se,group,gof_p\n";
  for (const RecoveryCase& c : r.cases)
    for (std::size_t k = 0; k < c.order.size(); ++k)
      out += fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(r.planted[c.planted]), c.seed, k + 1, csv_field(c.order[k]),
                         exact(c.scores[k]), exact(c.score_se[k]), c.group[k] > 0 ? std::to_string(c.group[k]) : "", exact(c.gof_p[k]));
  return out;
}

std::string to_json(const Recovery& r, const Settings& conditions) {
  Json planted = Json::array(), cases = Json::array(), settings = Json::object();
  for (const auto& [name, value] : conditions) settings[name] = value;
  for (std::size_t p = 0; p < r.planted.size(); ++p)
    planted.push_back({{"name", r.planted[p]},
                       {"parameters", parameters(r.rows[p], r.parameters[p])},
                       {"ranked_first", r.confusion[p]},
                       {"recovered", counts_of::recovered(r, p)},
                       {"recordings", counts_of::recordings(r, p)}});
  for (const RecoveryCase& c : r.cases)
    cases.push_back({{"true_model", r.planted[c.planted]},
                     {"seed", c.seed},
                     {"parameters", parameters(r.rows[c.planted], c.parameters)},
                     {"order", c.order},
                     {"scores", c.scores},
                     {"score_se", c.score_se},
                     {"group", c.group},
                     {"gof_p", c.gof_p}});
  const Json all = {{"schema", "swarmfit-recovery/2"},
                    {"conditions", std::move(settings)},
                    {"compared", r.compared},
                    {"true_models", std::move(planted)},
                    {"cases", std::move(cases)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_matrices(const std::string& dir, const Recovery& r, const Settings& settings) {
  std::string conditions;
  for (const auto& [name, value] : settings)
    if (name != "model" && name != "plant") conditions += fmt::format("{}{} {}", conditions.empty() ? "" : ", ", name, value);
  const auto caption = [&](const char* what) {
    return fmt::format("Rows: true model; columns: how often each model was {}. {}.", what, conditions);
  };
  for (const PaperTable& t :
       {confusion_table(r, caption("ranked first")),
        confidence_table(
            r, caption("not distinguishable from the best (model confidence set, 95 %); rejected: how often the true model was rejected "
                       "(p ≤ 0.05)"))})
    write_table(dir, t);
}

void write_recovery(const std::string& dir, const Recovery& r, const Settings& settings, const std::string& version) {
  begin_study(dir, "recover", settings);
  write_matrices(dir + "/tables", r, settings);
  write_file_atomically(dir + "/tables/cases.csv", recovery_csv(r));
  write_file_atomically(dir + "/report.html", recovery_html(r, settings, version));
  write_file_atomically(dir + "/recovery.json", to_json(r, settings));
}

}  // namespace swarmfit
