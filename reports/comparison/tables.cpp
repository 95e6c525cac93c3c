// SPDX-License-Identifier: MIT
#include "reports/comparison/tables.h"

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

std::string ranking(const Comparison& c) {
  Csv csv = with_header({"rank",
                         "model",
                         "score",
                         "score_se",
                         "score_lower",
                         "score_upper",
                         "lead_lower",
                         "lead_upper",
                         "group",
                         "set_p",
                         "gof_p",
                         "held_out_score",
                         "held_out_lead_lower",
                         "held_out_lead_upper",
                         "held_out_group",
                         "evaluations",
                         "simulations",
                         "failed_simulations",
                         "failed_final",
                         "n_sub",
                         "infeasible_avoidance",
                         "stop_reason"});
  for (const FitResult& r : c.models) {
    csv.field(rank_text(r.rank)).field(r.model).field(r.score).field(r.score_se);
    csv.field(r.certainty.lower)
        .field(r.certainty.upper)
        .field(r.certainty.lead_lower)
        .field(r.certainty.lead_upper)
        .field(rank_text(r.certainty.group))
        .field(r.certainty.set_p);
    csv.field(r.certainty.goodness_p).field(r.held_out.score);
    csv.field(r.held_out.certainty.lead_lower)
        .field(r.held_out.certainty.lead_upper)
        .field(rank_text(r.held_out.certainty.group))
        .field(r.evaluations)
        .field(r.simulations);
    csv.field(r.failed_simulations).field(r.failed_final).field(std::int64_t{r.steps}).field(r.infeasible_avoidance);
    csv.field(r.stop_reason).end();
  }
  return csv.take();
}

std::string energies(const Comparison& c) {
  Csv csv =
      with_header({"model", "metric", "raw", "raw_se", "own", "normalised", "half_step", "mean_ratio", "sd_ratio", "outside_fraction"});
  for (const FitResult& r : c.models) {
    for (std::size_t m = 0; m < c.columns.size(); ++m) {
      csv.field(r.model)
          .field(c.columns[m].key())
          .field(r.raw_energies[m])
          .field(r.raw_se[m])
          .field(r.certainty.own[m])
          .field(r.energies[m]);
      csv.field(r.half_step_energies[m]).field(r.mean_ratio[m]).field(r.sd_ratio[m]).field(r.outside_fraction[m]).end();
    }
  }
  return csv.take();
}

std::string raw_energies(const Comparison& c) {
  Csv csv;
  csv.field("model");
  for (std::size_t m = 0; m < c.columns.size(); ++m)
    if (counts(c, m)) csv.field(c.columns[m].key());
  csv.end();
  for (const FitResult& r : c.models) {
    csv.field(r.model);
    for (std::size_t m = 0; m < c.columns.size(); ++m)
      if (counts(c, m)) csv.field(r.raw_energies[m]);
    csv.end();
  }
  return csv.take();
}

std::string weights(const Comparison& c) {
  Csv csv = with_header({"pass", "metric", "weight", "p1", "p2", "largest_change"});
  for (const WeightStep& s : c.weight_history)
    for (std::size_t m = 0; m < c.columns.size(); ++m)
      csv.field(std::int64_t{s.pass})
          .field(c.columns[m].key())
          .field(s.weights[m])
          .field(s.p1[m])
          .field(s.p2[m])
          .field(s.largest_change)
          .end();
  for (std::size_t m = 0; m < c.columns.size(); ++m)
    csv.field("final").field(c.columns[m].key()).field(c.weights[m]).field(c.p1[m]).field(c.p2[m]).field("").end();
  return csv.take();
}

std::string lags(const Comparison& c) {
  Csv csv = with_header({"lag", "seconds", "columns_scored", "weight", "largest_error_share"});
  for (const LagFacts& l : c.lags) {
    if (l.lag > 0)
      csv.field(std::int64_t{l.lag}).field(l.lag * c.data.dt);
    else
      csv.field("none").field("");
    csv.field(std::int64_t{l.scored}).field(l.weight).field(l.error_share).end();
  }
  return csv.take();
}

std::string normalisation(const Comparison& c) {
  Csv csv = with_header({"metric", "p1", "p2", "resolution"});
  for (std::size_t m = 0; m < c.columns.size(); ++m)
    csv.field(c.columns[m].key()).field(c.p1[m]).field(c.p2[m]).field(c.resolution[m]).end();
  return csv.take();
}

std::string parameters(const Comparison& c) {
  Csv csv = with_header({"model", "parameter", "value", "unit", "lower", "upper", "fitted", "at_bound", "median", "ci_lower", "ci_upper",
                         "contraction", "verdict", "partner", "correlation", "meaning"});
  for (const FitResult& r : c.models) {
    for (const ParameterResult& p : r.parameters) {
      csv.field(r.model).field(p.name).field(p.value).field(p.unit).field(p.lower).field(p.upper);
      csv.field(p.fitted ? "true" : "false").field(p.at_bound ? "true" : "false");
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
  for (const FitResult& r : c.models) {
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
  return std::any_of(c.models.begin(), c.models.end(), [](const FitResult& r) { return r.posterior.simulations > 0; });
}

std::string sensitivity(const Comparison& c) {
  Csv csv = with_header({"model", "metric", "weight", "score", "score_without", "rank", "rank_without", "score_doubled"});
  for (const FitResult& r : c.models) {
    for (std::size_t m = 0; m < c.columns.size(); ++m) {
      const Sensitivity& s = r.sensitivity;
      csv.field(r.model).field(c.columns[m].key()).field(c.weights[m]).field(r.score).field(s.without[m]);
      csv.field(rank_text(r.rank)).field(rank_text(s.rank_without[m])).field(s.doubled[m]).end();
    }
  }
  return csv.take();
}

std::string pdfs(const Comparison& c) {
  Csv csv;
  csv.fields({"metric", "unit", "centre", "recording"});
  for (const FitResult& r : c.models) csv.field(r.model);
  csv.fields({"band_lower", "band_upper"}).end();
  for (std::size_t m = 0; m < c.columns.size(); ++m) {
    std::vector<std::vector<double>> columns = {physical_density(c.recording[m].histogram, c.axis_width[m])};
    for (const FitResult& r : c.models) columns.push_back(physical_density(r.distributions[m].histogram, c.axis_width[m]));
    auto [lower, upper] = physical_band(c, m);
    columns.push_back(std::move(lower));
    columns.push_back(std::move(upper));
    for (std::size_t bin = 0; bin < c.recording[m].histogram.counts.size(); ++bin) {
      const double centre = c.axis_lower[m] + (static_cast<double>(bin) + 0.5) * c.axis_width[m];
      csv.field(c.columns[m].key()).field(metric_unit(c.columns[m].metric, c.data.unit)).field(centre);
      for (const auto& column : columns) csv.field(bin < column.size() ? exact(column[bin]) : std::string());
      csv.end();
    }
  }
  return csv.take();
}

std::string convergence(const Comparison& c) {
  Csv csv = with_header({"model", "pass", "evaluations", "best"});
  for (const FitResult& r : c.models)
    for (const ConvergencePoint& p : r.convergence) csv.field(r.model).field(std::int64_t{p.pass}).field(p.evaluations).field(p.best).end();
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
  if (column >= c.band.lower.size()) return {};
  const auto per_unit = [&](std::vector<double> shares) {
    for (double& share : shares) share /= c.axis_width[column];
    return shares;
  };
  return {per_unit(c.band.lower[column]), per_unit(c.band.upper[column])};
}

std::vector<NamedTable> result_tables(const Comparison& c) {
  std::vector<NamedTable> out = {
      {"ranking.csv", ranking(c)}, {"energies.csv", energies(c)},           {"raw_energies.csv", raw_energies(c)},
      {"weights.csv", weights(c)}, {"normalisation.csv", normalisation(c)}, {"parameters.csv", parameters(c)},
      {"pdfs.csv", pdfs(c)},       {"convergence.csv", convergence(c)},     {"sensitivity.csv", sensitivity(c)},
      {"lags.csv", lags(c)}};
  if (has_posterior(c)) out.push_back({"posterior.csv", posterior(c)});
  for (NamedTable& table : skill_tables(c)) out.push_back(std::move(table));
  return out;
}

std::string history_csv(const Comparison& c) {
  Csv csv;
  csv.fields({"model", "pass", "phase", "replicates", "failed"});
  for (const Column& column : c.columns) csv.field(column.key());
  csv.field("parameters").end();
  for (const HistoryRow& row : c.history) {
    csv.field(c.named.at(row.model)).field(std::int64_t{row.pass}).field(row.phase).field(std::int64_t{row.replicates});
    csv.field(std::int64_t{row.failed});
    for (const double energy : row.raw) csv.field(energy);
    csv.field(parameter_list(c.searched.at(row.model), row.x)).end();
  }
  return csv.take();
}

}  // namespace swarmfit
