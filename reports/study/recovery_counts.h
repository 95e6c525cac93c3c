// SPDX-License-Identifier: MIT
// What the tables and pages of a recovery count. Every number is of recordings made by one planted model.
#pragma once

#include <string>

#include "fit/results/recovery.h"

namespace swarmfit::counts_of {

int recordings(const Recovery&, std::size_t planted);
int recovered(const Recovery&, std::size_t planted);  // its maker is ranked first
int grouped(const Recovery&, std::size_t planted);    // the comparison could tell who is in the best group
int in_best_group(const Recovery&, std::size_t planted, const std::string& model);
int rejected(const Recovery&, std::size_t planted, const std::string& model);  // as not explaining the recording, p <= 0.05

}  // namespace swarmfit::counts_of
