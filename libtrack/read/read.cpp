// SPDX-License-Identifier: MIT
#include "libtrack/read/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "libtrack/error.h"
#include "libtrack/file.h"
#include "libtrack/read/formats.h"

namespace swarmfit {
namespace {

// Every format has one line here. The first that recognises the content reads it; plain text comes last, because it takes any text.
const std::array kReaders = {
    &kMatlab,
    &kPeTrack,
    &kDelimitedText,
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
    for (const Reader* reader : kReaders)
      if (reader->format.name == options.format) return *reader;
    throw InputError(fmt::format("`format`: '{}' is not known; expected one of {}", options.format, format_names()));
  }
  refuse_non_recordings(source);
  for (const Reader* reader : kReaders)
    if (reader->recognises(source, options)) return *reader;
  for (const Reader* reader : kReaders)
    if (has_usual_ending(source, reader->format.endings)) return *reader;
  throw InputError(fmt::format("{}: the format is not known; expected one of {}", source.name, format_names()));
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

Tracks read_tracks(const std::string& path, const ReadOptions& options) { return read_tracks_bytes(path, read_file(path), options); }

Tracks read_tracks_bytes(const std::string& name, std::string bytes, const ReadOptions& options) {
  if (options.fill_gaps < 0) throw InputError(fmt::format("`fill-gaps`: {} is negative; expected a number of frames", options.fill_gaps));
  if (bytes.empty()) throw InputError(name + ": the file is empty; expected a recording");
  const Source source{name, bytes};
  auto table = choose(source, options).read(source, options);
  auto sha256 = sha256_hex(bytes);
  bytes = std::string();  // recordings can be large: the text goes before the table is built
  return assemble(std::move(table), options, std::move(sha256));
}

std::span<const Format> formats() {
  static const auto list = [] {
    std::array<Format, kReaders.size()> out;
    std::transform(kReaders.begin(), kReaders.end(), out.begin(), [](const Reader* r) { return r->format; });
    return out;
  }();
  return list;
}

}  // namespace swarmfit
