// SPDX-License-Identifier: MIT
// Arrays as NumPy stores them, format versions 1 to 3 (numpy.lib.format). Arrays of Python objects are programs and refused.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

// A plain array of numbers, row-major.
struct NumberArray {
  std::string name;  // in its container
  std::vector<std::size_t> dims;
  std::vector<double> value;
  std::string shown() const;  // "name (100 x 12)"
};

inline bool is_npy(std::string_view bytes) { return bytes.starts_with("\x93NUMPY"); }

// What stands behind the header of an array of Python objects: a pickle. Nothing: it is no such array.
std::string_view npy_pickle(std::string_view bytes);

// Is this, as in "f8", a type of numbers?
bool is_number_type(std::string_view kind);

// The numbers of this type, as in "<f8", in so many dimensions, in C's or Fortran's order. Throws as parse_npy().
struct NumberLayout {
  std::string type;
  bool fortran = false;
  std::vector<std::size_t> dims;
};
NumberArray numbers_of(const std::string& file, const std::string& name, const NumberLayout& layout, std::string_view data);

// `file` and `name` are for messages. Throws InputError when the bytes are no array of numbers or more are claimed than are there.
NumberArray parse_npy(const std::string& file, const std::string& name, std::string_view bytes);

// Texts of fixed length, type '<U'. Throws as parse_npy().
bool is_npy_text(std::string_view bytes);
std::vector<std::string> parse_npy_texts(const std::string& file, const std::string& name, std::string_view bytes);

}  // namespace swarmfit
