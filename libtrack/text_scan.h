// SPDX-License-Identifier: MIT
// The inner loop of every delimited-text reader: fields of one line, without copying.
#pragma once

#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

namespace swarmfit {

// Lines of a text; '\r' before '\n' is cut off, and the last line needs no '\n'.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  // False at the end of the text.
  bool next(std::string_view& line) {
    if (rest_.empty()) return false;
    const void* end = std::memchr(rest_.data(), '\n', rest_.size());
    const std::size_t length = end ? static_cast<std::size_t>(static_cast<const char*>(end) - rest_.data()) : rest_.size();
    line = rest_.substr(0, length);
    rest_.remove_prefix(end ? length + 1 : length);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    ++number_;
    return true;
  }
  long number() const { return number_; }  // of the line just read, from 1

 private:
  std::string_view rest_;
  long number_ = 0;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t'; }

// ASCII capitals become small letters.
inline std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

// Neither empty nor a comment.
inline bool has_content(std::string_view line) {
  std::size_t i = 0;
  while (i < line.size() && is_blank(line[i])) ++i;
  return i < line.size() && line[i] != '#' && line[i] != '%';
}

// Walks over the fields of one line. The delimiter ' ' stands for runs of blanks and tabs.
class Fields {
 public:
  Fields(std::string_view line, char delimiter) : begin_(line.data()), p_(begin_), end_(begin_ + line.size()), delimiter_(delimiter) {
    while (end_ > p_ && gap(end_[-1])) --end_;
    skip_gap();
  }

  bool done() const { return done_; }                                 // no field is left
  long column() const { return static_cast<long>(p_ - begin_) + 1; }  // of the field about to be read, from 1

  const char* rest() const { return p_; }  // the field about to be read and all that follows

  bool quoted() const { return p_ < end_ && *p_ == '"'; }  // is the field about to be read between quotes?

  // Reads a plain number; false, with nothing consumed, for anything else.
  bool number(double& value) {
    const auto [after, error] = std::from_chars(p_, end_, value);
    if (error != std::errc()) return false;
    const char* q = after;
    while (q < end_ && gap(*q)) ++q;
    if (q < end_ && *q != delimiter_ && !(delimiter_ == ' ' && q > after)) return false;
    step(q);
    return true;
  }

  // Reads any field: blanks around it and quotes are taken off. `scratch` is used when a quote has to be undoubled.
  std::string_view text(std::string& scratch) {
    if (p_ < end_ && *p_ == '"') return unquoted(scratch);
    const char* q = field_end();
    const char* last = q;
    while (last > p_ && is_blank(last[-1])) --last;
    const std::string_view field(p_, static_cast<std::size_t>(last - p_));
    finish(q);
    return field;
  }

  void skip() {
    if (p_ < end_ && *p_ == '"') {
      std::string unused;
      text(unused);
    } else {
      finish(field_end());
    }
  }

 private:
  // Blanks that mean nothing: around a field, or between fields when blanks delimit.
  bool gap(char c) const { return c == ' ' || (c == '\t' && delimiter_ != '\t'); }
  void skip_gap() {
    while (p_ < end_ && gap(*p_)) ++p_;
  }
  const char* field_end() const {
    const char* q = p_;
    if (q == end_) return q;  // an empty text may have no address, which memchr does not take
    if (delimiter_ == ' ') {
      while (q < end_ && !is_blank(*q)) ++q;
      return q;
    }
    const void* hit = std::memchr(q, delimiter_, static_cast<std::size_t>(end_ - q));
    return hit ? static_cast<const char*>(hit) : end_;
  }
  void finish(const char* q) {
    while (q < end_ && gap(*q)) ++q;
    step(q);
  }
  // q: at the delimiter (for blanks: at the next field), or at the end of the line.
  void step(const char* q) {
    done_ = q == end_;
    p_ = done_ || delimiter_ == ' ' ? q : q + 1;
    skip_gap();
  }
  std::string_view unquoted(std::string& scratch) {
    scratch.clear();
    const char* q = p_ + 1;
    while (q < end_ && (*q != '"' || (q + 1 < end_ && q[1] == '"'))) {
      scratch += *q;
      q += *q == '"' ? 2 : 1;
    }
    // A missing closing quote, or text behind it, stays in the field, where it is reported as no number.
    if (q == end_) scratch.insert(scratch.begin(), '"');
    const char* after = q < end_ ? q + 1 : q;
    p_ = after;
    const char* stop = field_end();
    while (after < stop && is_blank(*after)) ++after;
    scratch.append(after, stop);
    finish(stop);
    return scratch;
  }

  const char* begin_;
  const char* p_;
  const char* end_;
  char delimiter_;
  bool done_ = false;
};

}  // namespace swarmfit
