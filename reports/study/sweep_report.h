// SPDX-License-Identifier: MIT
// A sweep as text, JSON, CSV and as a folder with figures and a page.
#pragma once

#include <string>

#include "fit/results/sweep.h"
#include "reports/write/run_folder.h"
#include "reports/write/text_table.h"

namespace swarmfit {

std::string sweep_text(const Sweep& sweep, TextStyle style);  // what states there are and how often, ranges of the order parameters
std::string to_json(const Sweep& sweep, const Settings& settings);
std::string cells_csv(const Sweep& sweep);  // a row per cell: places, means, standard deviations, shares of states
std::string runs_csv(const Sweep& sweep);   // a row per simulation

// sweep.json (last), tables/cells.csv, tables/runs.csv, figures/*.svg, report.html, config.toml. Throws InputError, RunError.
void write_sweep(const std::string& dir, const Sweep& sweep, const Settings& settings, const std::string& version);

}  // namespace swarmfit
