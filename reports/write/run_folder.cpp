// SPDX-License-Identifier: MIT
#include "reports/write/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "libtrack/error.h"
#include "libtrack/file.h"

namespace swarmfit {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark = "# A run of swarmfit";  // first words of every config.toml of ours

constexpr std::array kResults = {"results.json", "summary.json", "recovery.json",
                                 "power.json",   "measure.json", "sweep.json"};  // each is written last

bool has_result(const fs::path& dir) {
  return std::any_of(kResults.begin(), kResults.end(), [&](const char* result) { return fs::exists(dir / result); });
}

bool is_earlier_run(const fs::path& dir) {
  const fs::path config = dir / "config.toml";
  return fs::is_regular_file(config) && read_file(config.string()).starts_with(kMark);
}

// What a kill left of a file that was being written (libtrack/file.h).
bool is_torn(const fs::directory_entry& file) { return file.path().extension() == ".part"; }

}  // namespace

void remove_torn(const std::string& dir) {
  std::error_code failed;
  for (const auto& file : fs::directory_iterator(dir, failed))
    if (is_torn(file)) fs::remove(file.path(), failed);
}

void check_run_directory(const std::string& dir) {
  std::error_code failed;
  const fs::file_status status = fs::status(dir, failed);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw InputError(dir + ": is not a folder; expected one for the results");
  const fs::directory_iterator files(dir, failed);
  const bool empty = !failed && std::all_of(fs::begin(files), fs::end(files), is_torn);
  if (failed) throw RunError(dir + ": cannot read the folder: " + failed.message());
  if (!empty && !is_earlier_run(dir))
    throw InputError(dir + ": holds something else; expected a new or empty folder, or an earlier swarmfit run");
}

void begin_run(const std::string& dir, const std::string& config) {
  check_run_directory(dir);
  make_directory(dir);
  remove_torn(dir);
  // Results go first: a kill in between must not leave old ones beside new settings.
  std::error_code no_such_file;
  for (const char* result : kResults) fs::remove(fs::path(dir) / result, no_such_file);
  write_file_atomically(dir + "/config.toml", config);
}

std::string unfinished_run(const std::string& dir) {
  const fs::path root = dir;
  if (!fs::is_directory(root) || !is_earlier_run(root))
    throw InputError(dir + ": holds no run; expected the folder of one that was interrupted");
  if (has_result(root) && !fs::exists(root / "checkpoint"))
    throw InputError(dir + ": this run is complete; expected one that was interrupted");
  const std::string config = read_file((root / "config.toml").string());
  const auto open = config.find("\n["), close = config.find("]\n", open);
  return open == std::string::npos || close == std::string::npos ? "" : config.substr(open + 2, close - open - 2);
}

void require_finished_run(const std::string& dir) {
  const fs::path root = dir;
  if (!fs::is_directory(root) || !is_earlier_run(root)) throw InputError(dir + ": holds no run; expected the folder of one");
  if (!has_result(root)) throw InputError(dir + ": this run has not finished; expected one that has (swarmfit resume goes on with it)");
}

std::string config_toml(const std::string& command, const Settings& settings) {
  std::string out = fmt::format("{}: `swarmfit {} --config config.toml --out NEW_FOLDER` repeats it.\n[{}]\n", kMark, command, command);
  for (const auto& [key, value] : settings) out += fmt::format("{} = {}\n", key, value);
  return out;
}

void begin_study(const std::string& dir, const std::string& command, const Settings& settings) {
  begin_run(dir, config_toml(command, settings));
  make_directory(dir + "/tables");
}

}  // namespace swarmfit
