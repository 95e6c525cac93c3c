// SPDX-License-Identifier: MIT
// What was asked for, and every candidate that was simulated for it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "libeval/energy.h"

namespace swarmfit {

// Candidates of one search, and on how many seeds each is simulated.
struct SearchSize {
  int population, generations;  // their product is the number of candidates
  int replicates;
};

// How much searching is done per model and calibration pass (docs/search.md).
struct Budget {
  std::string name;
  SearchSize search;            // everywhere
  SearchSize selection;         // again, about the leaders, on fresh and more seeds
  int confirmation_replicates;  // the best of those, on seeds that favour none of them
  int final_replicates;         // the winner, on seeds that had no part in choosing it
  int passes;                   // of the calibration loop, at most
};

// One row of history.csv: a candidate that was simulated.
struct HistoryRow {
  std::size_t model;  // index into the order in which models were named
  int pass;
  std::string phase;      // "search"; "select" and "refine", on seeds of their own; "steps": again, in finer steps; "confirm", "final"
  std::vector<double> x;  // searched parameters, physical units, in table order
  Energies raw{};
  int replicates = 0;  // in these energies: all of the phase, or only the first if it was given up
  int failed = 0;      // replicates that blew up
};

struct RunRecord {
  std::string command;  // "compare", "fit" or "evaluate"
  std::string version;
  std::uint64_t seed = 0;
  std::string protocol;
  std::vector<std::string> common;  // parameters that were fitted once, with the model named first, and are the same for all
  Budget budget{};
  std::vector<std::string> named;                  // canonical names of the models in the order given
  std::vector<std::vector<std::string>> searched;  // names of the searched parameters, per named model
  std::vector<HistoryRow> history;
  std::vector<std::pair<std::string, std::string>> config;  // every resolved flag of the command, name and TOML value
};

}  // namespace swarmfit
