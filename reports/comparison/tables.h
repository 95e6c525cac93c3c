// SPDX-License-Identifier: MIT
// A comparison as CSV tables: one header line, UTF-8, quoted as in RFC 4180 where needed, lines ended by "\n", undefined numbers empty,
// numbers in a text that reads back as the same double.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fit/results/comparison.h"

namespace swarmfit {

struct NamedTable {
  std::string name;  // "ranking.csv"
  std::string csv;
};

// The files of tables/ in a run directory; a metric at another lag than 1 is a metric of its own, "v@4":
//   ranking.csv        one row per model: every entry of quantities() (reports/comparison/quantities.h)
//   energies.csv       one row per model and metric: every entry of column_quantities()
//   raw_energies.csv   rows models, columns metrics that count in the score: what `swarmfit weigh` takes
//   weights.csv        one row per calibration pass and metric, the final weights as pass "final"
//   lags.csv           one row per lag, and one for the columns without: how many are scored, their weight, the largest share of error
//   normalisation.csv  p1 and p2 per metric
//   parameters.csv     one row per model and parameter, physical units
//   pdfs.csv           one row per metric and bin: centre in physical units, density of the recording and of every model, per unit
//   sensitivity.csv    one row per model and metric: score and rank when its weight is dropped, score when it is doubled
//   convergence.csv    best score so far against candidates simulated
//   and those of reports/comparison/skill_tables.h
std::vector<NamedTable> result_tables(const Comparison&);

// Every candidate that was simulated: model, pass, phase, failed replicates, raw energies, parameters as "name=value;...".
std::string history_csv(const Comparison&);

// A field as RFC 4180 wants it: in quotes, with quotes doubled, if it holds a comma, a quote or a line break.
std::string csv_field(std::string_view text);

// Density of a histogram per physical unit: counts / (samples × width); empty without samples.
std::vector<double> physical_density(const Histogram&, double width);

// Lower and upper bounds of Comparison::band in one column, as such densities; empty where there is none.
std::pair<std::vector<double>, std::vector<double>> physical_band(const Comparison&, std::size_t column);

}  // namespace swarmfit
