// SPDX-License-Identifier: MIT
#include "reports/run/run_directory.h"

#include <filesystem>

#include "libtrack/file.h"
#include "reports/comparison/figures.h"
#include "reports/comparison/html.h"
#include "reports/comparison/json.h"
#include "reports/comparison/methods.h"
#include "reports/comparison/paper_tables.h"
#include "reports/comparison/tables.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

namespace fs = std::filesystem;

namespace {

// Figures of an earlier run that this one does not draw.
void remove_earlier_figures(const fs::path& dir) {
  std::error_code failed;
  for (const auto& file : fs::directory_iterator(dir, failed))
    if (is_figure(file.path().filename().string())) fs::remove(file.path(), failed);
}

}  // namespace

void write_run(const std::string& dir, const Comparison& c) {
  // The mark first: whatever happens from here on, the next run may clean up after this one.
  begin_run(dir, config_toml(c.run.command, c.run.config));
  const fs::path root = dir, tables = root / "tables", drawn = root / "figures";
  for (const fs::path& folder : {tables, drawn}) make_directory(folder.string());
  for (const fs::path& folder : {root, tables, drawn}) remove_torn(folder.string());
  const auto write = [](const fs::path& path, const std::string& text) { write_file_atomically(path.string(), text); };
  for (const NamedTable& t : result_tables(c)) write(tables / t.name, t.csv);
  for (const PaperTable& t : paper_tables(c)) write_table(tables.string(), t);
  remove_earlier_figures(drawn);
  const std::vector<Figure> all = figures(c);
  for (const Figure& f : all) write(drawn / (f.name + ".svg"), f.svg);
  write(drawn / "captions.md", captions_markdown(all));
  write(drawn / "captions.tex", captions_latex(all));
  write(root / "history.csv", history_csv(c));
  write(root / "report.html", report_html(c));
  write(root / "methods.md", methods_markdown(c));
  write(root / "methods.tex", methods_latex(c));
  write(root / "results.json", to_json(c));
}

}  // namespace swarmfit
