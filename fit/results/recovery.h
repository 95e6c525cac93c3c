// SPDX-License-Identifier: MIT
// Which model wins on whose recording?
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace swarmfit {

struct RecoveryCase {
  std::size_t planted;             // index into Recovery::planted
  std::uint64_t seed;              // of the recording and of the comparison
  std::vector<double> parameters;  // planted, one per row of the model's table
  std::vector<std::string> order;  // models by rank, those without a score last
  std::vector<double> scores;      // in that order
  std::vector<double> score_se;
  std::vector<int> group;  // those of one group cannot be told apart (Certainty::group)
  std::vector<double> gof_p;
  int rank_of_planted = 0;  // 0: its score is undefined
};
inline auto fields(RecoveryCase& c) {  // as bytes (fit/store/bytes.h)
  return std::tie(c.planted, c.seed, c.parameters, c.order, c.scores, c.score_se, c.group, c.gof_p, c.rank_of_planted);
}

// A row of a planted model's parameter table.
struct PlantedRow {
  std::string name, symbol, unit, meaning;  // unit: "mm/s^2"; "" for a pure number
  bool used = true;                         // with the model's options
};

struct Recovery {
  std::vector<std::string> planted, compared;   // canonical names
  std::vector<std::vector<PlantedRow>> rows;    // of each planted model
  std::vector<std::vector<double>> parameters;  // about which they are planted, one per row of each model's table
  std::vector<RecoveryCase> cases;              // by planted model, then seed
  std::vector<std::vector<int>> confusion;      // planted × compared: how often was it ranked first?
};

}  // namespace swarmfit
