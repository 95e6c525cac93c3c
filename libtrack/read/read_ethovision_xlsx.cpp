// SPDX-License-Identifier: MIT
// Raw data that EthoVision XT exports as a spreadsheet: each sheet is one subject in one arena, with a preamble whose first line says how
// long it is, a row of names and a row of units; '-' where the subject was not seen. The centre is the position unless --node says
// otherwise. https://www.noldus.com/ethovision-xt
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/postures.h"
#include "libtrack/read/xlsx.h"
#include "libtrack/read/xml_file.h"

namespace swarmfit {
namespace {

constexpr std::string_view kFirstCell = "Number of header lines:";

bool recognises(const Source& source, const ReadOptions&) {
  if (!is_zip(source.bytes)) return false;
  const ZipFile zip(source.name, source.bytes);
  if (!zip.has(kWorkbook)) return false;
  const bool inline_text =
      zip.has("xl/worksheets/sheet1.xml") && zip.read("xl/worksheets/sheet1.xml").find(kFirstCell) != std::string::npos;
  return inline_text || (zip.has("xl/sharedStrings.xml") && zip.read("xl/sharedStrings.xml").find(kFirstCell) != std::string::npos);
}

// One sheet: what its preamble says and where its columns are.
class Track {
 public:
  Track(const std::string& file, const Sheet& sheet) : file_(file), sheet_(sheet) {
    const auto lines = xml_number(cell(0, 1));
    if (!lines || *lines < 3 || *lines > static_cast<double>(sheet.rows.size()))
      fail(1, "does not say how many header lines there are; expected a number");
    header_ = static_cast<std::size_t>(*lines);
    const auto& names = sheet.rows[header_ - 2];
    for (std::size_t c = 0; c < names.size(); ++c) {
      if (names[c] == "Trial time") time_ = c;
      if (names[c].starts_with("X ")) add_node(names[c].substr(2), c);
    }
    if (time_ == none || nodes.empty()) fail(header_ - 1, "has no columns Trial time, X center and Y center; expected raw data");
    if (unit(time_) != "s") fail(header_, fmt::format("has times in '{}'; expected s", unit(time_)));
  }

  std::vector<std::string> nodes;
  std::string length_unit;

  std::string said(std::string_view key) const {
    for (std::size_t r = 0; r < header_; ++r)
      if (cell(r, 0) == key) return cell(r, 1);
    return {};
  }

  void add_to(Postures& postures, std::uint32_t track) const {
    std::vector<double> x(nodes.size()), y(nodes.size());
    for (std::size_t r = header_; r < sheet_.rows.size(); ++r) {
      if (sheet_.rows[r].empty()) continue;
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        x[n] = number(r, x_[n]);
        y[n] = number(r, y_[n]);
      }
      const double time = number(r, time_);
      if (time != time) fail(r + 1, "has no time; expected one in every row");
      postures.add({track, kNaN, time, x, y, {}, {}});
    }
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  [[noreturn]] void fail(std::size_t row, const std::string& what) const {
    throw InputError(fmt::format("{}: sheet '{}' row {} {}", file_, sheet_.name, row, what));
  }

  std::string cell(std::size_t row, std::size_t column) const {
    return row < sheet_.rows.size() && column < sheet_.rows[row].size() ? sheet_.rows[row][column] : std::string();
  }
  std::string unit(std::size_t column) const { return cell(header_ - 1, column); }

  double number(std::size_t row, std::size_t column) const {
    const auto text = cell(row, column);
    if (text.empty() || text == "-") return kNaN;
    if (const auto value = xml_number(text)) return *value;
    fail(row + 1, fmt::format("has '{}' among its numbers; expected a number or -", text.substr(0, 40)));
  }

  void add_node(const std::string& node, std::size_t column) {
    const auto& names = sheet_.rows[header_ - 2];
    const auto hit = std::find(names.begin(), names.end(), "Y " + node);
    if (hit == names.end()) return;
    nodes.push_back(node);
    x_.push_back(column);
    y_.push_back(static_cast<std::size_t>(hit - names.begin()));
    if (nodes.size() == 1) length_unit = unit(column);
    if (unit(x_.back()) != length_unit || unit(y_.back()) != length_unit) fail(header_, "has positions in several units; expected one");
  }

  const std::string& file_;
  const Sheet& sheet_;
  std::size_t header_ = 0, time_ = none;
  std::vector<std::size_t> x_, y_;  // columns of the nodes
};

// Sheets with tracks; others are notes.
std::vector<Track> tracks_of(const std::string& file, const std::vector<Sheet>& sheets, const ReadOptions& options) {
  std::vector<Track> out;
  std::vector<std::string> names;
  std::set<std::string> trials;
  for (const auto& sheet : sheets) {
    if (sheet.rows.empty() || sheet.rows[0].empty() || sheet.rows[0][0] != kFirstCell) continue;
    names.push_back(sheet.name);
    if (!options.variable.empty() && sheet.name != options.variable) continue;
    out.emplace_back(file, sheet);
    trials.insert(out.back().said("Trial name"));
  }
  if (names.empty()) throw InputError(fmt::format("{}: no sheet begins with '{}'; expected raw data of EthoVision XT", file, kFirstCell));
  if (out.empty())
    throw InputError(fmt::format("`var`: {} has no sheet '{}' with a track; expected one of {}", file, options.variable, listed(names)));
  if (trials.size() > 1)
    throw InputError(fmt::format("{}: its sheets are of {} trials, which are not one recording; expected `var` SHEET, one of {}", file,
                                 trials.size(), listed(names)));
  return out;
}

RawTable read(const Source& source, const ReadOptions& options) {
  if (!is_zip(source.bytes)) throw InputError(source.name + ": this is not a spreadsheet (.xlsx); expected raw data of EthoVision XT");
  const ZipFile zip(source.name, source.bytes);
  if (!zip.has(kWorkbook)) throw InputError(source.name + ": this is not a spreadsheet (.xlsx); expected raw data of EthoVision XT");
  const auto sheets = read_xlsx(source.name, zip);
  const auto tracks = tracks_of(source.name, sheets, options);
  RawTable table;
  table.file = source.name;
  table.unit = tracks[0].length_unit;
  Postures postures(table, options, tracks[0].nodes, "center");
  std::set<std::string> seen;
  for (const auto& track : tracks) {
    if (track.nodes != tracks[0].nodes || track.length_unit != table.unit)
      throw InputError(source.name + ": its sheets have different points or units; expected `var` SHEET");
    const auto subject = track.said("Subject name"),
               name = tracks.size() == 1 ? subject : fmt::format("{} {}", track.said("Arena name"), subject);
    if (!seen.insert(name).second) throw InputError(fmt::format("{}: two sheets are of '{}'; expected `var` SHEET", source.name, name));
    track.add_to(postures, table.names.number(name));
  }
  postures.finish();
  return table;
}

}  // namespace

const Reader kEthoVisionXlsx = {{"ethovision-xlsx", "raw data of EthoVision XT, a spreadsheet", ".xlsx"}, recognises, read};

}  // namespace swarmfit
