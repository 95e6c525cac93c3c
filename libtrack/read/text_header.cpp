// SPDX-License-Identifier: MIT
#include "libtrack/read/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "libtrack/error.h"
#include "libtrack/read/timestamp.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

bool is_number(const std::string& field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size();
}

bool is_value(const std::string& field) { return is_number(field) || parse_timestamp(field) || parse_date(field); }

// A line of names: at least one field is text, and none is a value.
bool is_header(const std::vector<std::string>& fields) {
  return std::none_of(fields.begin(), fields.end(), is_value) &&
         std::any_of(fields.begin(), fields.end(), [](const auto& f) { return !is_missing(f); });
}

// The number behind the first ':' of a comment; 0 when there is none.
double number_behind_colon(std::string_view comment) {
  auto at = comment.find(':');
  if (at == std::string_view::npos) return 0;
  do ++at;
  while (at < comment.size() && is_blank(comment[at]));
  double value = 0;
  std::from_chars(comment.data() + at, comment.data() + comment.size(), value);
  return value;
}

std::string word_behind_colon(std::string_view comment) {
  auto at = comment.find(':');
  if (at == std::string_view::npos) return {};
  do ++at;
  while (at < comment.size() && is_blank(comment[at]));
  return std::string(comment.substr(at, comment.find_first_of(" \t", at) - at));
}

std::vector<std::int64_t> integers_behind_colon(std::string_view comment) {
  std::vector<std::int64_t> out;
  const char* p = comment.data() + comment.find(':') + 1;
  const char* end = comment.data() + comment.size();
  for (;;) {
    while (p < end && (is_blank(*p) || *p == ',')) ++p;
    std::int64_t value = 0;
    const auto [after, error] = std::from_chars(p, end, value);
    if (error != std::errc()) return out;
    out.push_back(value);
    p = after;
  }
}

// "x in cm" and "[in m]" of older PeTrack files; "x/cm" and "x [cm]" are found when the column names are read.
std::string unit_in_words(const std::string& comment) {
  for (const std::string_view unit : {"mm", "cm", "m"}) {
    for (const auto* form : {"[in {}]", "(in {})", "x in {} "}) {
      if ((comment + ' ').find(fmt::format(fmt::runtime(form), unit)) != std::string::npos) return std::string(unit);
    }
  }
  return {};
}

void read_comment(std::string_view line, TextHeader& header) {
  line.remove_prefix(line.find_first_of("#%") + 1);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  const auto text = lower(line);
  const auto starts = [&](std::string_view key) { return text.starts_with(key); };
  if (starts("framerate:") || starts("frame rate:") || starts("fps:")) {
    const double fps = number_behind_colon(text);
    if (fps > 0 && header.dt == 0) header.dt = 1 / fps;
  } else if (starts("frame interval:")) {
    header.dt = number_behind_colon(text);
  } else if (starts("time of frame 0:")) {
    header.t0 = number_behind_colon(text);
  } else if (starts("unit:")) {
    header.unit = word_behind_colon(line);
  } else if (starts("synthetic:")) {
    const std::string answer = word_behind_colon(text);
    header.synthetic = answer != "no" && answer != "false" && answer != "0";
  } else if (starts("episodes:")) {
    header.episodes = integers_behind_colon(text);
  } else if (header.unit.empty()) {
    header.unit = unit_in_words(text);
  }
  if (text.find("petrack") != std::string::npos) header.petrack = true;
}

// The first of ; tab , that cuts all sampled lines into equally many fields; else the first that cuts the first line; else blanks.
char find_delimiter(const std::vector<std::string_view>& sample) {
  constexpr std::array candidates = {';', '\t', ','};
  for (const char c : candidates) {
    const auto count = split_fields(sample.front(), c).size();
    if (count >= 2 && std::all_of(sample.begin(), sample.end(), [&](auto line) { return split_fields(line, c).size() == count; })) return c;
  }
  for (const char c : candidates)
    if (split_fields(sample.front(), c).size() >= 3) return c;
  return ' ';
}

void refuse_other_encodings(const std::string& name, std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw InputError(name + ": the text is UTF-16; expected UTF-8 (save it as CSV UTF-8)");
}

}  // namespace

std::vector<std::string> split_fields(std::string_view line, char delimiter) {
  std::vector<std::string> out;
  std::string scratch;
  Fields fields(line, delimiter);
  do out.emplace_back(fields.text(scratch));
  while (!fields.done());
  return out;
}

bool is_missing(std::string_view field) {
  if (field.empty() || field == "-") return true;
  if (field.size() > 4) return false;
  const auto word = lower(field);
  return word == "na" || word == "nan" || word == "null" || word == "none" || word == "n/a" || word == "-nan";
}

TextHeader look_at_text(const std::string& name, std::string_view bytes, const ReadOptions& options) {
  refuse_other_encodings(name, bytes);
  TextHeader header;
  const std::size_t mark = bytes.starts_with(kUtf8Mark) ? kUtf8Mark.size() : 0;

  // Comments, then up to five lines with content.
  constexpr std::size_t most = 5;
  std::vector<std::string_view> sample;
  std::vector<long> number;
  std::string_view comment_line;
  long comment_number = 0;
  Lines lines(bytes.substr(mark));
  for (std::string_view line; sample.size() < most && lines.next(line);) {
    if (has_content(line)) {
      sample.push_back(line);
      number.push_back(lines.number());
    } else if (sample.empty() && line.find_first_of("#%") != std::string_view::npos) {
      comment_line = line;
      comment_number = lines.number();
      read_comment(line, header);
    }
  }
  if (sample.empty()) throw InputError(name + ": the file is empty; expected rows of numbers");

  header.delimiter = options.delimiter.value_or(find_delimiter(sample));
  auto fields = split_fields(sample[0], header.delimiter);
  std::size_t first = 0;
  if (is_header(fields)) {
    header.names = std::move(fields);
    header.names_line = number[0];
    if (sample.size() < 2) throw InputError(at(name, number[0], 0, "there is a header but no row; expected rows of numbers"));
    first = 1;
    fields = split_fields(sample[1], header.delimiter);
  } else if (!comment_line.empty()) {
    comment_line.remove_prefix(comment_line.find_first_of("#%") + 1);
    auto names = split_fields(comment_line, header.delimiter);
    // Header words in a comment are often set with other blanks than the rows.
    if (names.size() != fields.size()) names = split_fields(comment_line, ' ');
    if (names.size() == fields.size() && is_header(names)) {
      header.names = std::move(names);
      header.names_line = comment_number;
      header.names_in_comment = true;
    }
  }
  header.first_row = std::move(fields);
  header.data_at = static_cast<std::size_t>(sample[first].data() - bytes.data());
  header.lines_before = number[first] - 1;
  return header;
}

}  // namespace swarmfit
