// SPDX-License-Identifier: MIT
#include "libtrack/read/join.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

namespace fs = std::filesystem;

// Whether `text` is what `pattern` stands for; * is any text, ? any letter.
bool matches(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = std::string_view::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++p;
      ++t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

// fish2 before fish10.
bool natural_name_order(const std::string& a, const std::string& b) {
  const auto digits = [](const std::string& s, std::size_t at) {
    const auto end = s.find_first_not_of("0123456789", at);
    return s.substr(at, end == std::string::npos ? end : end - at);
  };
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const auto m = digits(a, i), n = digits(b, j);
    if (!m.empty() && !n.empty() && m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
    if (a[i] != b[j]) return a[i] < b[j];
    ++i;
    ++j;
  }
  return a.size() < b.size();
}

void check_same_kind(const RawTable& first, const RawTable& other) {
  for (std::size_t c = 0; c < kNumberColumns; ++c)
    if (first.number[c].empty() != other.number[c].empty() || first.degrees != other.degrees)
      throw InputError(
          fmt::format("{}: the columns are not those of {}; expected the same in all files that are joined", other.file, first.file));
  if (first.unit != other.unit)
    throw InputError(fmt::format("{}: the length unit is '{}' but '{}' in {}; expected the same in all files that are joined", other.file,
                                 other.unit, first.unit, first.file));
  if (first.kinds != other.kinds)
    throw InputError(
        fmt::format("{}: the kinds are not those of {}; expected the same in all files that are joined", other.file, first.file));
  if (first.dt != other.dt || first.t0 != other.t0 || first.episodes != other.episodes)
    throw InputError(
        fmt::format("{}: the stated frame rate is not that of {}; expected the same in all files that are joined", other.file, first.file));
}

// The number in the joined table of every individual of one file.
std::vector<std::uint32_t> rename(const RawTable& table, RawTable& out) {
  const auto stem = fs::path(table.file).stem().string();
  const auto& names = table.names.names();
  std::vector<std::uint32_t> number;
  for (const auto& name : names) number.push_back(out.names.number(names.size() == 1 ? stem : fmt::format("{}/{}", stem, name)));
  return number;
}

void append(const RawTable& table, RawTable& out) {
  out.parts.push_back({table.file, out.track.size()});
  const auto number = rename(table, out);
  for (const auto k : table.track) out.track.push_back(k == RawTable::no_track ? k : number[k]);
  out.line.insert(out.line.end(), table.line.begin(), table.line.end());
  for (std::size_t c = 0; c < kNumberColumns; ++c)
    out.number[c].insert(out.number[c].end(), table.number[c].begin(), table.number[c].end());
}

}  // namespace

std::vector<std::string> files_to_join(const std::string& path) {
  std::error_code error;
  const bool folder = fs::is_directory(path, error);
  const fs::path within = folder ? fs::path(path) : fs::path(path).parent_path();
  const std::string pattern = folder ? "*" : fs::path(path).filename().string();
  std::vector<std::string> files;
  std::set<std::string> endings;
  for (const auto& entry : fs::directory_iterator(within.empty() ? fs::path(".") : within, error)) {
    const auto name = entry.path().filename().string();
    if (name.starts_with('.') || !matches(pattern, name) || entry.is_directory()) continue;
    files.push_back((within / name).string());
    endings.insert(entry.path().extension().string());
  }
  if (files.empty()) throw InputError(path + ": there is no such file; expected a folder, or a pattern such as 'fish*.csv'");
  if (folder && endings.size() > 1)
    throw InputError(fmt::format("{}: there are files of several endings, {} and {}; expected a pattern such as '{}'", path,
                                 *endings.begin(), *endings.rbegin(), (within / ("*" + *endings.begin())).string()));
  std::sort(files.begin(), files.end(), natural_name_order);
  return files;
}

std::string common_pattern(const std::vector<std::string>& files) {
  const fs::path first = files.front();
  const auto alike = [&](auto part) {
    return std::all_of(files.begin(), files.end(), [&](const fs::path& f) { return part(f) == part(first); });
  };
  const auto folder = [](const fs::path& f) { return f.parent_path(); };
  const auto ending = [](const fs::path& f) { return f.extension(); };
  return ((alike(folder) ? folder(first) : fs::path()) / ("*" + (alike(ending) ? ending(first).string() : ""))).string();
}

RawTable joined(const std::string& name, std::vector<RawTable> tables) {
  RawTable out;
  out.file = name;
  const RawTable& first = tables.front();
  out.dt = first.dt;
  out.t0 = first.t0;
  out.unit = first.unit;
  out.degrees = first.degrees;
  out.columns = first.columns;
  out.format = first.format;
  out.row_name = first.row_name;
  out.episodes = first.episodes;
  out.kinds = first.kinds;
  std::map<std::string, std::size_t> notes;
  for (const auto& table : tables) {
    check_same_kind(first, table);
    append(table, out);
    out.synthetic = out.synthetic || table.synthetic;
    for (const auto& note : table.notes) ++notes[note];
  }
  if (out.line.size() < out.track.size()) out.line.clear();  // some container in it has no lines
  out.notes.push_back(fmt::format("{} files were joined, individuals named by their files", tables.size()));
  for (const auto& [note, count] : notes)
    if (!note.starts_with("the file has no id column"))
      out.notes.push_back(count == tables.size() ? note : fmt::format("in {} files: {}", count, note));
  return out;
}

}  // namespace swarmfit
