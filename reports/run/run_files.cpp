// SPDX-License-Identifier: MIT
#include "reports/run/run_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "libtrack/error.h"
#include "reports/write/run_folder.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;

// Files of a folder with this ending, and what they are to be called.
void add_files(std::vector<RunFile>& out, const fs::path& dir, const std::string& ending, const std::string& new_ending) {
  std::error_code no_such_folder;
  for (const auto& file : fs::directory_iterator(dir, no_such_folder)) {
    const fs::path& path = file.path();
    if (file.is_regular_file() && path.extension() == ending) out.push_back({path.string(), path.stem().string() + new_ending});
  }
}

std::string what_to_do(const fs::path& root, bool figures) {
  if (fs::exists(root / "summary.json")) return "this is a summary of several recordings; expected the folder of one of them, inside it";
  return fmt::format(
      "expected the folder of a fit or compare of this version; `swarmfit compare --config {}/config.toml --out NEW_FOLDER` "
      "makes one again{}",
      root.string(), figures ? ", with figures" : "");
}

}  // namespace

std::vector<RunFile> run_files(const std::string& dir, std::string_view format) {
  require_finished_run(dir);
  const fs::path root = dir;
  const bool figures = format == "svg" || format == "pdf";
  const std::string ending = figures ? ".svg" : fmt::format(".{}", format), new_ending = fmt::format(".{}", format);
  std::vector<RunFile> out;
  if (figures || format == "tex" || format == "md") add_files(out, root / "figures", ending, new_ending);
  if (format == "csv" || format == "tex" || format == "md") add_files(out, root / "tables", ending, new_ending);
  if (format == "html" || format == "tex" || format == "md") add_files(out, root, ending, new_ending);
  if (out.empty()) throw InputError(fmt::format("{}: holds nothing as {}: {}", dir, format, what_to_do(root, figures)));
  std::sort(out.begin(), out.end(), [](const RunFile& a, const RunFile& b) { return a.name < b.name; });
  return out;
}

}  // namespace swarmfit
