// SPDX-License-Identifier: MIT
// What a finished run holds in the format that somebody asks for.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

struct RunFile {
  std::string path;  // in the folder of the run
  std::string name;  // what it is to be called: that of the file, with the ending of the format
};

// The formats: "svg" and "pdf" (the figures, which are SVG on disk), "tex" and "md" (tables, methods, captions), "csv" (tables), "html"
// (the report). Files in the order of their names. Throws InputError if `dir` holds no run, one that has not finished, or nothing in this
// format.
std::vector<RunFile> run_files(const std::string& dir, std::string_view format);

}  // namespace swarmfit
