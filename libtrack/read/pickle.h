// SPDX-License-Identifier: MIT
// Plain values that Python has pickled, without unpickling: None, numbers, texts, tuples, lists, dicts, and arrays of NumPy. Nothing is run
// or looked up. Protocols 2 to 5 (Python's module pickletools describes the opcodes); of callables only those are known with which NumPy
// writes arrays, types and scalars, and only what they would return is remembered.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/read/npy.h"

namespace swarmfit {

inline bool is_pickle(std::string_view bytes) { return bytes.size() > 1 && bytes[0] == '\x80' && bytes[1] >= 2 && bytes[1] <= 5; }

struct PickleValue {
  enum class Kind : std::uint8_t { none, number, text, bytes, sequence, dict, callable, type, array };
  Kind kind = Kind::none;
  double number = 0;                 // truth values too; of a callable which one
  std::string_view text{};           // texts, bytes; of a type as in "f8"
  bool characters = false;           // of bytes: written as a text, a character each
  bool fortran = false;              // of an array
  char order = '<';                  // of the bytes of a type
  std::vector<std::size_t> items{};  // values in a sequence; key, value, key, value ... in a dict; type and data of an array
  std::vector<std::size_t> dims{};   // of an array
};

class Pickle {
 public:
  // `bytes` must outlive it; `file` is for messages. Throws InputError when something else is in it, or more than a million values.
  Pickle(std::string file, std::string_view bytes);

  // The value that was pickled; of an array without dimensions that holds an object, that object.
  const PickleValue& root() const { return values_[root_]; }
  // What a dict holds under this key; nullptr: nothing.
  const PickleValue* find(const PickleValue& dict, std::string_view key) const;
  const PickleValue& item(const PickleValue& of, std::size_t number) const { return values_[of.items[number]]; }

  // Throws as parse_npy().
  NumberArray array(const std::string& name, const PickleValue& array) const;
  // All arrays of numbers, with their keys: those of a dict at the root, or the root alone.
  std::vector<NumberArray> arrays() const;

 private:
  bool is_numbers(const PickleValue& value) const;

  std::string file_;
  std::size_t size_;
  std::deque<PickleValue> values_;
  std::size_t root_ = 0;
};

}  // namespace swarmfit
