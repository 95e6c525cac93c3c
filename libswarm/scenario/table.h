// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libswarm/scenario/keys.h"
#include "libswarm/scenario/node.h"

namespace swarmfit {

// A table of a TOML file whose keys are asked for one by one; what nobody asked for is refused in the end. Every function throws InputError
// "file:line:column: what is wrong; what was expected". Borrows path and table.
class Table {
 public:
  // `heading` is how errors call it: "[bounds]", or nothing for the file itself.
  Table(const std::string& path, const Node& table, std::string heading);

  bool has(std::string_view key);
  std::string text(std::string_view key, std::optional<std::string> otherwise);  // nothing otherwise: it must be there
  // Words and ranges are those of scenario_keys(), unless others are given.
  std::string choice(std::string_view key, std::optional<std::string> otherwise);
  std::string choice(std::string_view key, std::span<const std::string_view> allowed, std::optional<std::string> otherwise);
  double number(std::string_view key, std::optional<double> otherwise);
  double number(std::string_view key, std::optional<double> otherwise, NumberRange allowed);
  std::int64_t whole(std::string_view key, std::optional<std::int64_t> otherwise);
  // [x, y, z], or [x, y] in two dimensions.
  Eigen::Array3d place(std::string_view key, std::optional<Eigen::Array3d> otherwise, int dims);
  std::vector<double> numbers(std::string_view key);                               // one, or an array of them
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t least);  // an array of arrays of equal length
  std::optional<Table> table(std::string_view key);                                // [key]
  std::vector<Table> tables(std::string_view key);                                 // [[key]]

  std::vector<std::string> keys() const;  // in the order of the file
  void finish() const;                    // refuses keys that nobody asked for
  std::string place_of(std::string_view key) const;
  std::string place() const;
  const std::string& path() const { return *path_; }                              // of the file
  std::string beside(const std::string& file) const;                              // in the same folder, if it is not an absolute path
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const;  // at the key
  [[noreturn]] void refuse(const std::string& what) const;                        // at the table

 private:
  const Node* find(std::string_view key) const;
  const Node* ask(std::string_view key);
  const Node& need(std::string_view key);
  const ScenarioKey& known(std::string_view key) const;
  std::vector<double> numbers_of(std::string_view key, const Node& node) const;
  std::string called(std::string_view key) const;

  const std::string* path_;
  const Node* node_;
  std::string heading_;
  std::vector<std::string> asked_;
};

// The value as a number, if it is a finite one.
std::optional<double> number_of(const Node& node);

}  // namespace swarmfit
