// SPDX-License-Identifier: MIT
// A study done as several jobs: --part and merge.
#pragma once

#include <string>
#include <vector>

#include "fit/study/recovery.h"

namespace swarmfit::cli {

// "k/n" as --part takes it. Throws InputError.
Part parse_part(const std::string& text);

// Leaves word in the folder of a part that it is done, and says how to go on. Returns the exit code.
int part_done(const std::string& dir, const Part& part, bool quiet);

// Makes one run of the parts of a study, which resume then finishes. Throws InputError where one is missing, unfinished or of another
// study.
void merge_parts(const std::vector<std::string>& dirs, const std::string& out);

}  // namespace swarmfit::cli
