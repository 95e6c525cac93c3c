// SPDX-License-Identifier: MIT
#include "reports/html.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/assets.h"
#include "reports/html_sections.h"
#include "reports/html_table.h"
#include "reports/number.h"
#include "reports/page.h"
#include "reports/run_directory.h"
#include "reports/tables.h"
#include "reports/words.h"

namespace swarmfit {
namespace {

using Json = nlohmann::ordered_json;

// ---- numbers for the charts ---------------------------------------------------------------------------------------------------

// Five digits are more than a screen can show and keep the page small.
Json short_number(double value) { return std::isfinite(value) ? Json::parse(fmt::format("{:.5g}", value)) : Json(); }

template <class Values>
Json short_numbers(const Values& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(short_number(value));
  return out;
}

Json metric_data(const Comparison& c, std::size_t m) {
  const Column& column = c.columns[m];
  Json models = Json::array();
  for (const FitResult& r : c.models) models.push_back(short_numbers(physical_density(r.distributions[m].histogram, c.axis_width[m])));
  return {{"key", column.key()},
          {"symbol", column.symbol()},
          {"name", column.name()},
          {"unit", metric_unit(column.metric, c.data.unit)},
          {"density_unit", density_unit(column.metric, c.data.unit)},
          {"counts", counts(c, m)},
          {"lower", c.axis_lower[m]},
          {"width", c.axis_width[m]},
          {"recording", short_numbers(physical_density(c.recording[m].histogram, c.axis_width[m]))},
          {"models", std::move(models)}};
}

Json model_data(const FitResult& r) {
  Json convergence = Json::array();
  for (const ConvergencePoint& p : r.convergence) convergence.push_back({p.pass, p.evaluations, short_number(p.best)});
  return {{"name", r.model},
          {"energies", short_numbers(r.raw_energies)},
          {"errors", short_numbers(r.raw_se)},
          {"convergence", std::move(convergence)}};
}

Json chart_data(const Comparison& c) {
  Json metrics = Json::array(), models = Json::array(), history = Json::array();
  for (std::size_t m = 0; m < c.columns.size(); ++m) metrics.push_back(metric_data(c, m));
  for (const FitResult& r : c.models) models.push_back(model_data(r));
  for (const WeightStep& s : c.weight_history) history.push_back({{"pass", s.pass}, {"weights", short_numbers(s.weights)}});
  return {{"metrics", std::move(metrics)},
          {"models", std::move(models)},
          {"weights", short_numbers(c.weights)},
          {"history", std::move(history)}};
}

// ---- the page -----------------------------------------------------------------------------------------------------------------

std::string policy() { return content_policy(assets::report_css, {assets::chart_js, assets::report_js}); }

PageValues page_values(const Comparison& c) {
  const Headline answer = headline(c);
  return {{"policy", policy()},
          {"css", std::string(assets::report_css)},
          {"chart_js", std::string(assets::chart_js)},
          {"js", std::string(assets::report_js)},
          {"data", embedded(chart_data(c).dump(-1, ' ', false, Json::error_handler_t::replace))},
          {"title", html_escaped(fmt::format("{} – swarmfit", answer.sentence))},
          {"kind", c.command == "fit" ? "fit" : "comparison"},
          {"badge", sections::badge(c).text},
          {"sentence", html_escaped(answer.sentence)},
          {"detail", html_escaped(answer.detail)},
          {"facts", sections::data_facts(c).text},
          {"warnings", sections::warnings(c).text},
          {"ranking", sections::ranking(c).text},
          {"final_replicates", std::to_string(c.budget.final_replicates)},
          {"energy", html_escaped(what_energy_means(c))},
          {"energy_formula", sections::energy_formula(c).text},
          {"legend", sections::legend(c).text},
          {"pdf_figures", sections::pdf_figures(c).text},
          {"pdf_note", sections::pdf_note(c).text},
          {"moments", sections::moments(c).text},
          {"weights_converged", sections::weights_converged(c).text},
          {"weights", sections::weights(c).text},
          {"lags", sections::lags(c).text},
          {"parameters", sections::parameters(c).text},
          {"search", sections::search(c).text},
          {"observation", sections::observation(c).text},
          {"skill", sections::skill(c).text},
          {"without", sections::without(c).text},
          {"panel", sections::panel(c).text},
          {"methods", sections::methods(c).text},
          {"model_references", sections::model_references(c).text},
          {"command", html_escaped(fmt::format("swarmfit {} --config config.toml --out NEW_FOLDER", c.command))},
          {"provenance", sections::provenance(c).text},
          {"config", html_escaped(config_toml(c.command, c.config))},
          {"version", html_escaped(c.version)}};
}

}  // namespace

std::string report_html(const Comparison& c) { return filled(assets::report_html, page_values(c)); }

}  // namespace swarmfit
