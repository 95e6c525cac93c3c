// SPDX-License-Identifier: MIT
#include "reports/run_directory.h"

#include <fmt/format.h>

#include <filesystem>

#include "libtrack/error.h"
#include "libtrack/file.h"
#include "reports/html.h"
#include "reports/json.h"
#include "reports/paper_tables.h"
#include "reports/tables.h"

namespace swarmfit {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark = "# A run of swarmfit";  // first words of every config.toml of ours

bool is_earlier_run(const fs::path& dir) {
  const fs::path config = dir / "config.toml";
  return fs::is_regular_file(config) && read_file(config.string()).starts_with(kMark);
}

}  // namespace

void check_run_directory(const std::string& dir) {
  std::error_code failed;
  const fs::file_status status = fs::status(dir, failed);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) throw InputError(dir + ": is not a folder; expected one for the results");
  const bool empty = fs::is_empty(dir, failed);
  if (failed) throw RunError(dir + ": cannot read the folder: " + failed.message());
  if (!empty && !is_earlier_run(dir))
    throw InputError(dir + ": holds something else; expected a new or empty folder, or an earlier swarmfit run");
}

void write_run(const std::string& dir, const Comparison& c) {
  check_run_directory(dir);
  const fs::path root = dir, tables = root / "tables";
  make_directory(tables.string());
  const auto write = [](const fs::path& path, const std::string& text) { write_file_atomically(path.string(), text); };
  // The mark first: whatever happens from here on, the next run may clean up after this one.
  write(root / "config.toml", config_toml(c.command, c.config));
  std::error_code no_such_file;
  fs::remove(root / "results.json", no_such_file);
  for (const NamedTable& t : result_tables(c)) write(tables / t.name, t.csv);
  for (const PaperTable& t : paper_tables(c)) {
    write(tables / (t.name + ".md"), to_markdown(t));
    write(tables / (t.name + ".tex"), to_latex(t));
  }
  write(root / "history.csv", history_csv(c));
  write(root / "report.html", report_html(c));
  write(root / "results.json", to_json(c));
}

std::string config_toml(const std::string& command, const Settings& settings) {
  std::string out = fmt::format("{}: `swarmfit {} --config config.toml --out NEW_FOLDER` repeats it.\n[{}]\n", kMark, command, command);
  for (const auto& [key, value] : settings) out += fmt::format("{} = {}\n", key, value);
  return out;
}

}  // namespace swarmfit
