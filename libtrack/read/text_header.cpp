// SPDX-License-Identifier: MIT
#include "libtrack/read/text_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <span>

#include "libtrack/error.h"
#include "libtrack/read/timestamp.h"
#include "libtrack/read/units.h"
#include "libtrack/text_scan.h"

namespace swarmfit {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";

bool is_number(const std::string& field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size();
}

bool is_value(const std::string& field) { return is_number(field) || parse_timestamp(field) || parse_date(field); }

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

// Between quotes, as our own files have it, where there are blanks or quotes in it.
std::string word_behind_colon(std::string_view comment) {
  auto at = comment.find(':');
  if (at == std::string_view::npos) return {};
  do ++at;
  while (at < comment.size() && is_blank(comment[at]));
  if (at < comment.size() && comment[at] == '"') {
    std::string scratch;
    Fields fields(comment.substr(at), '\0');
    return std::string(fields.text(scratch));
  }
  return std::string(comment.substr(at, comment.find_first_of(" \t", at) - at));
}

// The words between semicolons.
std::vector<std::string> names_behind_colon(std::string_view comment) {
  std::vector<std::string> out;
  for (std::size_t at = comment.find(':') + 1; at <= comment.size();) {
    const std::size_t end = std::min(comment.find(';', at), comment.size());
    std::string_view name = comment.substr(at, end - at);
    while (!name.empty() && is_blank(name.front())) name.remove_prefix(1);
    while (!name.empty() && (is_blank(name.back()) || name.back() == '\r')) name.remove_suffix(1);
    out.emplace_back(name);
    at = end + 1;
  }
  return out;
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

std::string_view trimmed_note(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && (is_blank(text.back()) || text.back() == '\r')) text.remove_suffix(1);
  return text;
}

void read_comment(std::string_view line, TextHeader& header) {
  line.remove_prefix(line.find_first_of("#%") + 1);
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  const auto text = lower(line);
  const auto starts = [&](std::string_view key) { return text.starts_with(key); };
  if (starts("note:")) {
    header.notes.emplace_back(trimmed_note(line.substr(5)));
    return;
  }
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
  } else if (starts("kinds:")) {
    header.kinds = names_behind_colon(line);
  } else if (starts("episodes:")) {
    header.episodes = integers_behind_colon(text);
  } else if (header.unit.empty()) {
    header.unit = unit_in_words(text);
  }
  if (text.find("petrack") != std::string::npos) header.petrack = true;
}

// The first of ; tab , that cuts all sampled lines into equally many fields; else the first that cuts the first line; else
// blanks.
char find_delimiter(std::span<const std::string_view> sample) {
  constexpr std::array candidates = {';', '\t', ','};
  for (const char c : candidates) {
    const auto count = split_fields(sample.front(), c).size();
    if (count >= 2 && std::all_of(sample.begin(), sample.end(), [&](auto line) { return split_fields(line, c).size() == count; })) return c;
  }
  for (const char c : candidates)
    if (split_fields(sample.front(), c).size() >= 3) return c;
  for (const char c : candidates)
    if (split_fields(sample.front(), c).size() >= 2 && split_fields(sample.back(), c).size() >= 2) return c;
  return ' ';
}

void refuse_other_encodings(const std::string& name, std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    throw InputError(name + ": the text is UTF-16; expected UTF-8 (save it as CSV UTF-8)");
}

struct Sample {
  std::vector<std::string_view> line;  // the first ones with content
  std::vector<long> number;
  std::string_view comment;  // the last one before them
  long comment_number = 0;
};

constexpr std::size_t kSampleLines = 12, kLinesForDelimiter = 5;

// Comments, which go into the header, then the first lines with content.
Sample take_sample(const std::string& name, std::string_view text, TextHeader& header) {
  Sample sample;
  Lines lines(text);
  for (std::string_view line; sample.line.size() < kSampleLines && lines.next(line);) {
    if (has_content(line)) {
      sample.line.push_back(line);
      sample.number.push_back(lines.number());
    } else if (sample.line.empty() && line.find_first_of("#%") != std::string_view::npos) {
      sample.comment = line;
      sample.comment_number = lines.number();
      read_comment(line, header);
    }
  }
  if (sample.line.empty()) throw InputError(name + ": the file is empty; expected rows of numbers");
  return sample;
}

// Lines of a title above the names: of one or two words, where the names and their rows are three or more.
std::size_t title_lines(const Sample& sample) {
  for (const char c : {';', '\t', ','}) {
    for (std::size_t k = 0; k + 1 < sample.line.size(); ++k) {
      const auto fields = split_fields(sample.line[k], c);
      if (fields.size() < 3) {
        if (fields.size() > 2 || std::any_of(fields.begin(), fields.end(), is_value)) break;
        continue;
      }
      if (k > 0 && is_header(fields) && split_fields(sample.line[k + 1], c).size() == fields.size()) return k;
      break;
    }
  }
  return 0;
}

// A row of units below the names: "s","","m","m". Needs one that is known, and nothing longer than a unit.
bool is_unit_row(const std::vector<std::string>& fields) {
  bool known = false;
  for (const auto& field : fields) {
    if (field.empty()) continue;
    if (is_value(field) || field.size() > 12) return false;
    known = known || length_unit(field) || time_unit(field);
  }
  return known;
}

// Makes names fit the rows, where it is known why they do not.
void fit_names(const std::string& name, TextHeader& header) {
  auto& names = header.names;
  const auto& row = header.first_row;
  if (names.empty() || names.size() == row.size()) return;
  if (names.size() == row.size() + 1 && names.back().empty()) {
    names.pop_back();
  } else if (names.size() + 1 == row.size() && row.back().empty()) {
    names.emplace_back();  // every row ends in a delimiter
  } else if (names.size() + 1 == row.size()) {
    names.insert(names.begin(), std::string());
    header.notes.emplace_back("the header is one name short: the first column holds row names, as R writes them");
  } else {
    throw InputError(
        at(name, header.names_line, 0,
           fmt::format("the header has {} names but the first row has {} columns; expected as many", names.size(), row.size())));
  }
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

bool is_header(const std::vector<std::string>& fields) {
  return std::none_of(fields.begin(), fields.end(), is_value) &&
         std::any_of(fields.begin(), fields.end(), [](const auto& f) { return !is_missing(f); });
}

bool is_missing(std::string_view field) {
  if (field.empty() || field == "-" || field == ".") return true;
  if (field.size() > 9) return false;
  auto word = lower(field);
  if (word.front() == '#') word.erase(0, 1);  // of spreadsheets
  if (word.front() == '-' || word.front() == '+') word.erase(0, 1);
  constexpr std::array words = {"na", "nan", "null", "none", "n/a", "inf", "infinity", "nan(ind)"};
  return std::find(words.begin(), words.end(), word) != words.end();
}

TextHeader look_at_text(const std::string& name, std::string_view bytes, const ReadOptions& options) {
  refuse_other_encodings(name, bytes);
  TextHeader header;
  const std::size_t mark = bytes.starts_with(kUtf8Mark) ? kUtf8Mark.size() : 0;

  const Sample sample = take_sample(name, bytes.substr(mark), header);
  std::string_view comment_line = sample.comment;

  std::size_t first = title_lines(sample);
  if (first > 0)
    header.notes.push_back(
        fmt::format("{} of a title above the column names were passed over", first == 1 ? "a line" : fmt::format("{} lines", first)));
  const auto rest = std::span(sample.line).subspan(first);
  header.delimiter = options.delimiter.value_or(find_delimiter(rest.first(std::min(rest.size(), kLinesForDelimiter))));
  auto fields = split_fields(rest[0], header.delimiter);
  const auto next = [&] {
    if (++first == sample.line.size())
      throw InputError(at(name, header.names_line, 0, "there is a header but no row; expected rows of numbers"));
    fields = split_fields(sample.line[first], header.delimiter);
  };
  if (is_header(fields)) {
    header.names = fields;
    header.names_line = sample.number[first];
    header.names_text = sample.line[first];
    next();
    if (is_unit_row(fields) && fields.size() == header.names.size()) {
      for (std::size_t i = 0; i < fields.size(); ++i)
        if (!fields[i].empty()) header.names[i] += fmt::format(" [{}]", fields[i]);
      next();
    }
  } else if (!comment_line.empty()) {
    comment_line.remove_prefix(comment_line.find_first_of("#%") + 1);
    auto names = split_fields(comment_line, header.delimiter);
    // Header words in a comment are often set with other blanks than the rows.
    if (names.size() != fields.size()) names = split_fields(comment_line, ' ');
    if (names.size() == fields.size() && is_header(names)) {
      header.names = std::move(names);
      header.names_line = sample.comment_number;
      header.names_in_comment = true;
    }
  }
  header.first_row = std::move(fields);
  header.data_at = static_cast<std::size_t>(sample.line[first].data() - bytes.data());
  header.lines_before = sample.number[first] - 1;
  fit_names(name, header);
  return header;
}

std::size_t column_named(std::string_view column, const TextHeader& header, const std::string& file, std::string_view program) {
  const auto found = std::find(header.names.begin(), header.names.end(), column);
  if (found == header.names.end())
    throw InputError(at(file, header.names_line, 0, fmt::format("there is no column '{}'; expected those of {}", column, program)));
  return static_cast<std::size_t>(found - header.names.begin());
}

}  // namespace swarmfit
