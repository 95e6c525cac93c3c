// SPDX-License-Identifier: MIT
#include "libtrack/read/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "libtrack/error.h"
#include "libtrack/nan.h"
#include "libtrack/read/text_header.h"

namespace swarmfit {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// "102,364": one to three digits that begin with no zero, a comma, three digits.
bool may_be_thousands(std::string_view text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
  const auto comma = text.find(',');
  return comma >= 1 && comma <= 3 && text.front() != '0' && text.size() == comma + 4;
}

}  // namespace

void Place::fail(long column, const std::string& what) const { throw InputError(at(name, line, column, what)); }

std::string shown(std::string_view field) { return '\'' + std::string(field.substr(0, 40)) + '\''; }

bool Numbers::plain(Fields& fields, const Place& place, double& value) {
  const char* start = fields.rest();
  const long column = fields.column();
  if (!fields.number(value)) return false;
  if (point_) return true;
  if (std::memchr(start, '.', static_cast<std::size_t>(fields.rest() - start)) == nullptr) return true;
  if (comma_)
    place.fail(column, fmt::format("a decimal point, but a decimal comma in line {}; expected one of them throughout", comma_line_));
  point_ = true;
  return true;
}

double Numbers::read(Fields& fields, const Place& place) {
  const long column = fields.column();
  double value = 0;
  if (plain(fields, place, value)) return value;
  return odd(fields.text(scratch_), place, column);
}

double Numbers::odd(std::string_view field, const Place& place, long column) {
  if (is_missing(field)) return kNaN;
  std::string_view digits = field;
  if (digits.size() > 1 && digits.front() == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool whole = end == digits.data() + digits.size();
  if (whole && error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(digits).c_str(), nullptr);
    if (std::abs(value) < 1) return value;  // too small for a double: zero or denormal
    place.fail(column, shown(field) + " is too large; expected a finite number");
  }
  if (whole && error == std::errc()) return value;
  if (digits.find(',') != std::string_view::npos) return with_comma(digits, place, column);
  place.fail(column, shown(field) + " is not a number; expected a number");
}

double Numbers::with_comma(std::string_view field, const Place& place, long column) {
  std::string text(field);
  *std::find(text.begin(), text.end(), ',') = '.';
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size() && std::any_of(text.begin(), text.end(), is_digit);
  if (point_ || decimal_ == "point" || !whole)
    place.fail(column, shown(field) + " is not a number; expected a decimal point instead of the comma");
  if (!comma_) {
    comma_line_ = place.line;
    comma_field_ = field;
  }
  comma_ = true;
  proved_ = proved_ || !may_be_thousands(field);
  return value;
}

void Numbers::check(const std::string& name) const {
  if (!comma_ || proved_ || delimiter_ == ';' || decimal_ == "comma") return;
  throw InputError(at(name, comma_line_, 0,
                      fmt::format("'{}' may have a decimal comma or one between thousands; expected `decimal` comma, or numbers without "
                                  "commas",
                                  comma_field_)));
}

}  // namespace swarmfit
