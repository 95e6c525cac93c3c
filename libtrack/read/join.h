// SPDX-License-Identifier: MIT
// Several files that are one recording.
#pragma once

#include <string>
#include <vector>

#include "libtrack/read/raw_table.h"

namespace swarmfit {

// The files of a folder, or those that a pattern with * and ? in its last part names, in natural order. Throws InputError when there are
// none, or a folder holds files of several endings.
std::vector<std::string> files_to_join(const std::string& path);

// What several files are called together: "goats/*.csv".
std::string common_pattern(const std::vector<std::string>& files);

// One table of all. A file with one individual names it ("fish0.csv": fish0), one with several comes before their names ("day1/3").
// Throws InputError when columns, unit or frame interval differ between files.
RawTable joined(const std::string& name, std::vector<RawTable> tables);

}  // namespace swarmfit
