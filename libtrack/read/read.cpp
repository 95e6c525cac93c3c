// SPDX-License-Identifier: MIT
#include "libtrack/read/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/read/formats.h"
#include "libtrack/read/join.h"
#include "libtrack/read/plain_text.h"
#include "libtrack/read/unpack.h"

namespace swarmfit {
namespace {

struct Entry {
  const Reader* reader;
  bool text;
};

// The first that recognises the content reads it.
const std::array kReaders = {
#define READER(name) Entry{&(name), false},
#define TEXT_READER(name) Entry{&(name), true},
#include "libtrack/read/readers.def"
#undef TEXT_READER
#undef READER
};

std::string format_names() {
  std::string out;
  for (const auto& format : formats()) out += fmt::format("{}{}", out.empty() ? "" : ", ", format.name);
  return out;
}

bool has_usual_ending(const Source& source, std::string_view endings) {
  while (!endings.empty()) {
    const auto cut = endings.find(' ');
    if (source.ends_with(endings.substr(0, cut))) return true;
    endings.remove_prefix(cut == std::string_view::npos ? endings.size() : cut + 1);
  }
  return false;
}

// By --format, else by content, else by the ending of the name.
const Reader& choose(const Source& source, const ReadOptions& options) {
  if (!options.format.empty()) {
    for (const auto& [reader, text] : kReaders)
      if (reader->format.name == options.format) return *reader;
    throw InputError(fmt::format("`format`: '{}' is not known; expected one of {}", options.format, format_names()));
  }
  bool refused = false;
  for (const auto& [reader, text] : kReaders) {
    if (text && !std::exchange(refused, true)) refuse_non_recordings(source);
    if (reader->recognises(source, options)) return *reader;
  }
  for (const auto& [reader, text] : kReaders)
    if (has_usual_ending(source, reader->format.endings)) return *reader;
  throw InputError(fmt::format("{}: the format is not known; expected one of {}", source.name, format_names()));
}

bool is_text(const Reader& reader) {
  return std::any_of(kReaders.begin(), kReaders.end(), [&](const Entry& e) { return e.reader == &reader && e.text; });
}

// A zero byte would end messages in which the text is quoted, and is in no text.
void refuse_zeros(const Source& source) {
  const auto zero = source.bytes.find('\0');
  if (zero == std::string_view::npos) return;
  const auto line = 1 + std::count(source.bytes.begin(), source.bytes.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
  throw InputError(at(source.name, line, 0, "there is a zero byte in it, so it is not text; expected text"));
}

// A flag about the points of a posture must have had something to choose from.
void check_point_flags(const RawTable& table, const Reader& reader, const ReadOptions& options) {
  if (!options.node.empty() && !table.has_nodes)
    throw InputError(
        fmt::format("`node` {}: {} ({}) has no named points; expected none given", options.node, table.file, reader.format.name));
  if (options.min_confidence && !table.has_confidence)
    throw InputError(fmt::format("`min-confidence`: {} ({}) has no confidences; expected none given", table.file, reader.format.name));
}

void check(const ReadOptions& options) {
  if (options.fill_gaps < 0) throw InputError(fmt::format("`fill-gaps`: {} is negative; expected a number of frames", options.fill_gaps));
  if (options.min_confidence && !(*options.min_confidence >= 0 && *options.min_confidence <= 1))
    throw InputError(fmt::format("`min-confidence`: {} is not a confidence; expected a number from 0 to 1", *options.min_confidence));
}

// Recordings can be large: the text goes before anything is built of the table.
RawTable read_table(const std::string& name, std::string bytes, const ReadOptions& options) {
  if (bytes.empty()) throw InputError(name + ": the file is empty; expected a recording");
  std::vector<std::string> notes;
  bytes = plain_bytes(unpacked(name, std::move(bytes), options.variable, notes));
  const Source source{name, bytes};
  const Reader& reader = choose(source, options);
  if (is_text(reader)) refuse_zeros(source);
  auto table = reader.read(source, options);
  table.format = reader.format.name;
  check_point_flags(table, reader, options);
  table.notes.insert(table.notes.begin(), notes.begin(), notes.end());
  return table;
}

double parse_end(std::string_view setting, std::string_view whole, std::string_view text, double open) {
  if (text.empty()) return open;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
  throw InputError(fmt::format("`{}`: '{}' is not a range; expected first:last, first: or :last", setting, whole));
}

}  // namespace

bool Source::ends_with(std::string_view ending) const {
  return name.size() >= ending.size() && std::equal(ending.rbegin(), ending.rend(), name.rbegin(), [](char a, char b) {
           return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
         });
}

const Hdf5Contents* Source::hdf5() const {
  if (!contents && bytes.starts_with("\x89HDF\r\n\x1a\n")) contents = std::make_shared<const Hdf5Contents>(list_hdf5(name, bytes));
  return contents.get();
}

const Reader& text_reader(const Source& source, const ReadOptions& options) {
  for (const auto& [reader, text] : kReaders)
    if (text && reader->recognises(source, options)) return *reader;
  return kDelimitedText;
}

Interval parse_interval(std::string_view setting, std::string_view text) {
  const auto cut = text.find(':');
  if (cut == std::string_view::npos || text.size() == 1)
    throw InputError(fmt::format("`{}`: '{}' is not a range; expected first:last, first: or :last", setting, text));
  Interval out;
  out.first = parse_end(setting, text, text.substr(0, cut), out.first);
  out.last = parse_end(setting, text, text.substr(cut + 1), out.last);
  if (out.first > out.last) throw InputError(fmt::format("`{}`: '{}' is empty; expected the smaller number first", setting, text));
  return out;
}

Tracks read_tracks(const std::string& path, const ReadOptions& options) {
  std::error_code error;
  if (!options.join && std::filesystem::is_directory(path, error))
    throw InputError(path + ": is a folder; expected a file, or `join` to read the files in it as one recording");
  if (!options.join) return read_tracks_bytes(path, read_file(path), options);
  check(options);
  std::vector<RawTable> tables;
  std::string digests;
  for (const auto& file : options.joined.empty() ? files_to_join(path) : options.joined) {
    std::string bytes = read_file(file);
    digests += sha256_hex(bytes);
    tables.push_back(read_table(file, std::move(bytes), options));
  }
  return assemble(joined(path, std::move(tables)), options, sha256_hex(digests));
}

Tracks read_tracks_bytes(const std::string& name, std::string bytes, const ReadOptions& options) {
  check(options);
  if (options.join) throw InputError(name + ": `join` takes files; expected a folder, or a pattern such as 'fish*.csv'");
  auto sha256 = sha256_hex(bytes);
  return assemble(read_table(name, std::move(bytes), options), options, std::move(sha256));
}

std::span<const Format> formats() {
  static const auto list = [] {
    std::array<Format, kReaders.size()> out;
    std::transform(kReaders.begin(), kReaders.end(), out.begin(), [](const Entry& e) { return e.reader->format; });
    return out;
  }();
  return list;
}

}  // namespace swarmfit
