// SPDX-License-Identifier: MIT
// Order parameters: numbers that say what a group does at one moment. One entry of the table per quantity.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libeval/group/moment.h"

namespace swarmfit {

struct OrderParameter {
  std::string_view key;         // in tables, JSON and on the command line
  std::string_view name;        // in words
  std::string_view symbol;      // in print
  int length, time;             // unit as powers of length and time
  std::string_view meaning;     // one line: formula, range
  double (*of)(const Moment&);  // NaN where it is undefined
};

// All of them, in the order in which they are shown.
std::span<const OrderParameter> order_table();

// Of this key, or null.
const OrderParameter* find_order_parameter(std::string_view key);
// "polarisation,extent", "all", "usual". Throws InputError.
std::vector<const OrderParameter*> order_parameters_named(const std::vector<std::string>& keys);

// Values by frame, one row per moment that was seen; a stream's visitor.
class OrderRecord {
 public:
  explicit OrderRecord(std::vector<const OrderParameter*> what) : what_(std::move(what)), values_(what_.size()) {}
  void add(const Moment& moment);

  const std::vector<const OrderParameter*>& what() const { return what_; }
  const std::vector<std::int64_t>& frame() const { return frame_; }
  const std::vector<double>& values(std::size_t parameter) const { return values_[parameter]; }
  // Of this key. Throws std::out_of_range if it was not recorded.
  const std::vector<double>& values(std::string_view key) const;

 private:
  std::vector<const OrderParameter*> what_;
  std::vector<std::int64_t> frame_;
  std::vector<std::vector<double>> values_;  // per parameter
};

OrderRecord order_record(const Tracks& tracks, const MomentOptions& options, std::vector<const OrderParameter*> what);

}  // namespace swarmfit
