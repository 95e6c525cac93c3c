// SPDX-License-Identifier: MIT
// What a run leaves on disk.
#pragma once

#include <string>

#include "fit/results/comparison.h"

namespace swarmfit {

// Writes config.toml, results.json, tables/, figures/, history.csv, report.html, methods.md and methods.tex, each of the files whole or not
// at all, creating folders as needed. results.json comes last: a directory that has one is complete. Throws InputError as above, RunError
// when writing fails.
void write_run(const std::string& dir, const Comparison&);

}  // namespace swarmfit
