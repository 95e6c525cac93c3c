// SPDX-License-Identifier: MIT
// Numbers as people's programs write them.
#pragma once

#include <string>
#include <string_view>

#include "libtrack/text_scan.h"

namespace swarmfit {

// Where parsing stands, for messages.
struct Place {
  const std::string& name;
  long line;
  [[noreturn]] void fail(long column, const std::string& what) const;  // throws InputError
};

// A field for a message, shortened.
std::string shown(std::string_view field);

// Reads the numbers of one file: with decimal points, or with decimal commas where the comma does not delimit; never with both. A comma
// before three digits may part thousands: unless semicolons delimit, some number must show that it does not.
class Numbers {
 public:
  Numbers(char delimiter, std::string_view decimal) : delimiter_(delimiter), decimal_(decimal) {}

  // NaN where the field is missing. Throws InputError at the field for anything else that is no number.
  double read(Fields& fields, const Place& place);

  // A number without oddities; false, with nothing consumed, for anything else.
  bool plain(Fields& fields, const Place& place, double& value);

  // Any other number, from its text.
  double odd(std::string_view field, const Place& place, long column);

  // At the end of the file. Throws InputError when commas may have parted thousands.
  void check(const std::string& name) const;

 private:
  double with_comma(std::string_view field, const Place& place, long column);

  char delimiter_;
  std::string_view decimal_;
  bool point_ = false, comma_ = false, proved_ = false;
  long comma_line_ = 0;
  std::string comma_field_, scratch_;
};

}  // namespace swarmfit
