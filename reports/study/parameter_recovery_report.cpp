// SPDX-License-Identifier: MIT
#include "reports/study/parameter_recovery_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "libtrack/file.h"
#include "reports/comparison/tables.h"
#include "reports/study/parameter_recovery_html.h"
#include "reports/write/json_parts.h"
#include "reports/write/number.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

using json_parts::finite;
using json_parts::Json;

}  // namespace

std::string coverage_band_text(const ParameterRecovery& r) {
  return fmt::format("Correct 95 % intervals contain {} to {} of {} true values (99 % of the binomial, {} parameters).", r.fewest, r.most,
                     r.cases.size(), r.parameters.size());
}

std::string ranks_text(const ParameterRecovery& r) {
  std::vector<std::string> beyond;
  for (const ParameterCoverage& p : r.parameters)
    if (p.from_uniform > r.uniform_band) beyond.push_back(p.name);
  if (r.parameters.size() > 1 && r.from_uniform > r.uniform_band) beyond.emplace_back("all parameters together");
  const std::string band = fmt::format("within {} of uniform, as those of correct posteriors are in 95 % of studies of {} recordings",
                                       fixed(r.uniform_band, 2), r.cases.size());
  if (beyond.empty()) return fmt::format("Ranks of true values in their posteriors are {}.", band);
  return fmt::format("Ranks of true values in their posteriors are not {}: those of {}.", band, enumerate(beyond));
}

std::string left_out_text(const ParameterRecovery& r) {
  if (r.left_out == 0) return {};
  return fmt::format(" {} more recordings were left out: they cannot be fitted, or the true value lies beyond the bounds of the search.",
                     r.left_out);
}

PaperTable coverage_table(const ParameterRecovery& r, const std::string& caption) {
  PaperTable t{"coverage", caption, {r.model, "covered", "identified", "one-sided", "flat", "mean width", "bias", "rmse"}, {}};
  for (const ParameterCoverage& p : r.parameters)
    t.rows.push_back({p.name, fmt::format("{} of {}", p.covered, p.recordings), std::to_string(p.identified), std::to_string(p.one_sided),
                      std::to_string(p.flat), fixed(p.width, 2), fixed(p.bias, 3), fixed(p.rmse, 3)});
  return t;
}

std::string parameter_recovery_text(const ParameterRecovery& r, TextStyle style) {
  if (r.cases.empty()) return fmt::format("None of {} recordings simulated from {} can be fitted.\n", r.left_out, r.model);
  const std::string text =
      table_text(coverage_table(r, ""), style) +
      paragraph("width, bias and rmse (of the posterior's median): fractions of the searched range, on the axis of the search", " ") +
      paragraph(coverage_band_text(r), " ") + paragraph(ranks_text(r), " ") + (r.left_out > 0 ? paragraph(left_out_text(r), " ") : "");
  return finished(text, style);
}

std::string parameter_cases_csv(const ParameterRecovery& r) {
  std::string out = "seed,parameter,truth,median,ci_lower,ci_upper,contraction,verdict,rank\n";
  for (const ParameterCase& c : r.cases)
    for (std::size_t k = 0; k < c.found.size(); ++k) {
      const ParameterInterval& p = c.found[k];
      out += fmt::format("{},{},{},{},{},{},{},{},{}\n", c.seed, csv_field(p.name), exact(c.truth[k]), exact(p.median), exact(p.lower),
                         exact(p.upper), exact(p.contraction), to_string(p.verdict), k < c.rank.size() ? exact(c.rank[k]) : "");
    }
  return out;
}

std::string to_json(const ParameterRecovery& r, const Settings& conditions) {
  Json parameters = Json::array(), settings = Json::object();
  for (const auto& [name, value] : conditions) settings[name] = value;
  for (const ParameterCoverage& p : r.parameters)
    parameters.push_back({{"name", p.name},
                          {"recordings", p.recordings},
                          {"covered", p.covered},
                          {"identified", p.identified},
                          {"one_sided", p.one_sided},
                          {"flat", p.flat},
                          {"width", p.width},
                          {"bias", p.bias},
                          {"rmse", p.rmse},
                          {"from_uniform", finite(p.from_uniform)}});
  const Json all = {{"schema", "swarmfit-parameter-recovery/1"},
                    {"conditions", std::move(settings)},
                    {"model", r.model},
                    {"recordings", r.cases.size()},
                    {"left_out", r.left_out},
                    {"band", {r.fewest, r.most}},
                    {"from_uniform", finite(r.from_uniform)},
                    {"uniform_band", finite(r.uniform_band)},
                    {"parameters", std::move(parameters)}};
  return all.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

void write_parameter_recovery(const std::string& dir, const ParameterRecovery& r, const Settings& settings, const std::string& version) {
  begin_study(dir, "recover", settings);
  write_table(dir + "/tables", coverage_table(r, "How often the 95 % interval contains the true value. " + coverage_band_text(r)));
  write_file_atomically(dir + "/tables/cases.csv", parameter_cases_csv(r));
  write_file_atomically(dir + "/report.html", parameter_recovery_html(r, settings, version));
  write_file_atomically(dir + "/recovery.json", to_json(r, settings));
}

}  // namespace swarmfit
