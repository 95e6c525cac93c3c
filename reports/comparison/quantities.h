// SPDX-License-Identifier: MIT
// The catalogue of what is told of a model in one number: key, heading, meaning, value and print of each stand in one entry. results.json,
// ranking.csv, the rankings of terminal, page and paper, and the notes of the page's headings follow.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "fit/results/comparison.h"

namespace swarmfit {

using IntervalEnds = std::pair<double, double>;

// An undefined number is NaN, a rank or group that is not known is empty.
using Value = std::variant<double, std::int64_t, bool, std::string, std::optional<int>, IntervalEnds>;

// Who reads a ranking. Each shows what those before it show, and more.
enum class Audience { terminal, page, nobody };

struct Quantity {
  std::string_view key;      // "held_out.score" is a key of the object held_out, and held_out_score in tables; intervals end in _ci
  std::string_view meaning;  // a sentence without its full stop
  Value (*of)(const ModelFit&);
  std::string_view head{};                                                                // in rankings
  Audience first = Audience::nobody;                                                      // of the readers who see it there
  std::string (*print)(const Comparison&, const ModelFit&, Audience audience) = nullptr;  // for them
};

const std::vector<Quantity>& quantities();

// Is it known in this comparison at all?
bool known(const Quantity& quantity, const Comparison& c);

// Those that this reader sees in a ranking, in order.
std::vector<const Quantity*> ranking_columns(const Comparison& c, Audience audience);

// The same of numbers that every model has per column of the energy table.
struct ColumnQuantity {
  std::string_view key;    // in results.json
  std::string_view table;  // in energies.csv
  std::string_view meaning;
  const PerColumn<double>& (*of)(const ModelFit&);
};

const std::vector<ColumnQuantity>& column_quantities();

}  // namespace swarmfit
