// SPDX-License-Identifier: MIT
#include "reports/comparison/tables.h"

#include "reports/comparison/force_tables.h"
#include "reports/comparison/picture_tables.h"
#include "reports/comparison/quantities.h"
#include "reports/comparison/skill_tables.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit {

namespace {

// Collects fields into lines.
class Csv {
 public:
  Csv& field(std::string_view text) {
    if (!first_) text_ += ',';
    first_ = false;
    text_ += csv_field(text);
    return *this;
  }
  Csv& field(double value) { return field(exact(value)); }
  Csv& field(std::int64_t value) { return field(std::to_string(value)); }
  Csv& fields(std::initializer_list<std::string_view> texts) {
    for (const auto text : texts) field(text);
    return *this;
  }
  void end() {
    text_ += '\n';
    first_ = true;
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  bool first_ = true;
};

Csv with_header(std::initializer_list<std::string_view> names) {
  Csv csv;
  csv.fields(names).end();
  return csv;
}

std::string rank_text(int rank) { return rank > 0 ? std::to_string(rank) : std::string(); }

// "held_out.lead_ci" is in two columns, held_out_lead_lower and held_out_lead_upper.
std::vector<std::string> table_keys(const Quantity& q, const Value& value) {
  std::string key(q.key);
  std::replace(key.begin(), key.end(), '.', '_');
  if (!std::holds_alternative<IntervalEnds>(value)) return {key};
  key.resize(key.size() - std::string_view("_ci").size());
  return {key + "_lower", key + "_upper"};
}

void add(Csv& csv, const Value& value) {
  std::visit(
      [&](const auto& v) {
        using T = std::decay_t<decltype(v)>;
        if constexpr (std::is_same_v<T, IntervalEnds>)
          csv.field(v.first).field(v.second);
        else if constexpr (std::is_same_v<T, std::optional<int>>)
          csv.field(v ? std::to_string(*v) : std::string());
        else if constexpr (std::is_same_v<T, bool>)
          csv.field(v ? "true" : "false");
        else
          csv.field(v);
      },
      value);
}

// Held-out columns stand there where nothing is held out, too, so that tables of several comparisons can be put together.
std::string ranking(const Comparison& c) {
  Csv csv;
  const ModelFit nobody;
  for (const Quantity& q : quantities()) {
    for (const std::string& key : table_keys(q, q.of(nobody))) csv.field(key);
    if (&q == &quantities().front()) csv.field("model");
  }
  csv.end();
  for (const ModelFit& r : c.models) {
    for (const Quantity& q : quantities()) {
      if (known(q, c))
        add(csv, q.of(r));
      else
        for (std::size_t k = table_keys(q, q.of(r)).size(); k > 0; --k) csv.field("");
      if (&q == &quantities().front()) csv.field(r.model);
    }
    csv.end();
  }
  return csv.take();
}

std::string energies(const Comparison& c) {
  Csv csv;
  csv.fields({"model", "metric"});
  for (const ColumnQuantity& q : column_quantities()) csv.field(q.table);
  csv.end();
  for (const ModelFit& r : c.models)
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m) {
      csv.field(r.model).field(c.recording.columns[m].key());
      for (const ColumnQuantity& q : column_quantities()) csv.field(q.of(r)[m]);
      csv.end();
    }
  return csv.take();
}

std::string raw_energies(const Comparison& c) {
  Csv csv;
  csv.field("model");
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    if (counts(c, m)) csv.field(c.recording.columns[m].key());
  csv.end();
  for (const ModelFit& r : c.models) {
    csv.field(r.model);
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
      if (counts(c, m)) csv.field(r.runs.raw_energies[m]);
    csv.end();
  }
  return csv.take();
}

std::string weights(const Comparison& c) {
  Csv csv = with_header({"pass", "metric", "weight", "p1", "p2", "largest_change"});
  for (const WeightStep& s : c.ranking.weight_history)
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
      csv.field(std::int64_t{s.pass})
          .field(c.recording.columns[m].key())
          .field(s.weights[m])
          .field(s.p1[m])
          .field(s.p2[m])
          .field(s.largest_change)
          .end();
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    csv.field("final")
        .field(c.recording.columns[m].key())
        .field(c.ranking.weights[m])
        .field(c.ranking.p1[m])
        .field(c.ranking.p2[m])
        .field("")
        .end();
  return csv.take();
}

std::string lags(const Comparison& c) {
  Csv csv = with_header({"lag", "seconds", "columns_scored", "weight", "largest_error_share"});
  for (const LagFacts& l : c.ranking.lags) {
    if (l.lag > 0)
      csv.field(std::int64_t{l.lag}).field(l.lag * c.recording.data.dt);
    else
      csv.field("none").field("");
    csv.field(std::int64_t{l.scored}).field(l.weight).field(l.error_share).end();
  }
  return csv.take();
}

std::string normalisation(const Comparison& c) {
  Csv csv = with_header({"metric", "p1", "p2", "resolution"});
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m)
    csv.field(c.recording.columns[m].key()).field(c.ranking.p1[m]).field(c.ranking.p2[m]).field(c.recording.resolution[m]).end();
  return csv.take();
}

std::string parameters(const Comparison& c) {
  Csv csv = with_header({"model",
                         "parameter",
                         "value",
                         "unit",
                         "lower",
                         "upper",
                         "fitted",
                         "at_bound",
                         "halves_lower",
                         "halves_upper",
                         "likelihood",
                         "likelihood_lower",
                         "likelihood_upper",
                         "regression",
                         "regression_lower",
                         "regression_upper",
                         "median",
                         "ci_lower",
                         "ci_upper",
                         "contraction",
                         "verdict",
                         "partner",
                         "correlation",
                         "meaning"});
  for (const ModelFit& r : c.models) {
    for (const ParameterResult& p : r.parameters) {
      csv.field(r.model).field(p.name).field(p.value).field(p.unit).field(p.lower).field(p.upper);
      csv.field(p.fitted ? "true" : "false").field(p.at_bound ? "true" : "false").field(p.halves_lower).field(p.halves_upper);
      for (const SecondOpinion& o : {p.likelihood, p.regression}) csv.field(o.value).field(o.lower).field(o.upper);
      const ParameterUncertainty& u = p.posterior;
      csv.field(u.median).field(u.lower).field(u.upper).field(u.contraction).field(u.verdict).field(u.partner).field(u.correlation);
      csv.field(p.meaning).end();
    }
  }
  return csv.take();
}

// One row per point of a posterior's sample and parameter.
std::string posterior(const Comparison& c) {
  Csv csv = with_header({"model", "point", "weight", "parameter", "value", "unit"});
  for (const ModelFit& r : c.models) {
    std::vector<const ParameterResult*> searched;
    for (const ParameterResult& p : r.parameters)
      if (p.fitted) searched.push_back(&p);
    for (std::size_t k = 0; k < r.posterior.sample.size(); ++k)
      for (std::size_t p = 0; p < searched.size(); ++p)
        csv.field(r.model)
            .field(static_cast<std::int64_t>(k + 1))
            .field(r.posterior.weight[k])
            .field(searched[p]->name)
            .field(r.posterior.sample[k][p])
            .field(searched[p]->unit)
            .end();
  }
  return csv.take();
}

bool has_posterior(const Comparison& c) {
  return std::any_of(c.models.begin(), c.models.end(), [](const ModelFit& r) { return r.posterior.simulations > 0; });
}

std::string sensitivity(const Comparison& c) {
  Csv csv = with_header({"model", "metric", "weight", "score", "score_without", "rank", "rank_without", "score_doubled"});
  for (const ModelFit& r : c.models) {
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m) {
      const Sensitivity& s = r.standing.sensitivity;
      csv.field(r.model)
          .field(c.recording.columns[m].key())
          .field(c.ranking.weights[m])
          .field(r.standing.in_sample.score)
          .field(s.without[m]);
      csv.field(rank_text(r.standing.in_sample.rank)).field(rank_text(s.rank_without[m])).field(s.doubled[m]).end();
    }
  }
  return csv.take();
}

std::string pdfs(const Comparison& c) {
  Csv csv;
  csv.fields({"metric", "unit", "centre", "recording"});
  for (const ModelFit& r : c.models) csv.field(r.model);
  csv.fields({"band_lower", "band_upper"}).end();
  for (std::size_t m = 0; m < c.recording.columns.size(); ++m) {
    std::vector<std::vector<double>> columns = {physical_density(c.recording.distributions[m].histogram, c.recording.axis_width[m])};
    for (const ModelFit& r : c.models) columns.push_back(physical_density(r.runs.distributions[m].histogram, c.recording.axis_width[m]));
    auto [lower, upper] = physical_band(c, m);
    columns.push_back(std::move(lower));
    columns.push_back(std::move(upper));
    for (std::size_t bin = 0; bin < c.recording.distributions[m].histogram.counts.size(); ++bin) {
      const double centre = c.recording.axis_lower[m] + (static_cast<double>(bin) + 0.5) * c.recording.axis_width[m];
      csv.field(c.recording.columns[m].key()).field(metric_unit(c.recording.columns[m].metric, c.recording.data.unit)).field(centre);
      for (const auto& column : columns) csv.field(bin < column.size() ? exact(column[bin]) : std::string());
      csv.end();
    }
  }
  return csv.take();
}

std::string convergence(const Comparison& c) {
  Csv csv = with_header({"model", "pass", "evaluations", "best"});
  for (const ModelFit& r : c.models)
    for (const ConvergencePoint& p : r.search.convergence)
      csv.field(r.model).field(std::int64_t{p.pass}).field(p.evaluations).field(p.best).end();
  return csv.take();
}

std::string parameter_list(const std::vector<std::string>& names, const std::vector<double>& values) {
  std::string out;
  for (std::size_t k = 0; k < names.size() && k < values.size(); ++k) {
    if (k > 0) out += ';';
    out += names[k] + '=' + exact(values[k]);
  }
  return out;
}

}  // namespace

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::vector<double> physical_density(const Histogram& histogram, double width) {
  const double upper = width * static_cast<double>(histogram.counts.size());
  return density(histogram, 0, upper);
}

std::pair<std::vector<double>, std::vector<double>> physical_band(const Comparison& c, std::size_t column) {
  if (column >= c.ranking.band.lower.size()) return {};
  const auto per_unit = [&](std::vector<double> shares) {
    for (double& share : shares) share /= c.recording.axis_width[column];
    return shares;
  };
  return {per_unit(c.ranking.band.lower[column]), per_unit(c.ranking.band.upper[column])};
}

std::vector<NamedTable> result_tables(const Comparison& c) {
  std::vector<NamedTable> out = {
      {"ranking.csv", ranking(c)}, {"energies.csv", energies(c)},           {"raw_energies.csv", raw_energies(c)},
      {"weights.csv", weights(c)}, {"normalisation.csv", normalisation(c)}, {"parameters.csv", parameters(c)},
      {"pdfs.csv", pdfs(c)},       {"convergence.csv", convergence(c)},     {"sensitivity.csv", sensitivity(c)},
      {"lags.csv", lags(c)}};
  if (!c.recording.pictures.recording.density.empty()) out.push_back({"pictures.csv", pictures_csv(c)});
  if (!c.recording.forces.recording.drag.empty()) out.push_back({"forces.csv", forces_csv(c)});
  if (has_posterior(c)) out.push_back({"posterior.csv", posterior(c)});
  for (NamedTable& table : skill_tables(c)) out.push_back(std::move(table));
  return out;
}

std::string history_csv(const Comparison& c) {
  Csv csv;
  csv.fields({"model", "pass", "phase", "replicates", "failed"});
  for (const Column& column : c.recording.columns) csv.field(column.key());
  csv.field("parameters").end();
  for (const HistoryRow& row : c.run.history) {
    csv.field(c.run.named.at(row.model)).field(std::int64_t{row.pass}).field(row.phase).field(std::int64_t{row.replicates});
    csv.field(std::int64_t{row.failed});
    for (const double energy : row.raw) csv.field(energy);
    csv.field(parameter_list(c.run.searched.at(row.model), row.x)).end();
  }
  return csv.take();
}

}  // namespace swarmfit
