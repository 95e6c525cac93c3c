// SPDX-License-Identifier: MIT
// MATLAB files through matio, with every size checked before memory is taken.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

// A real numeric array, column-major as in MATLAB.
struct MatArray {
  std::vector<std::size_t> dims;
  std::vector<double> value;
};

// What a MAT file says about a variable before its data are read.
struct MatVariable {
  std::string name;
  std::vector<std::size_t> dims;
  bool numeric = false;  // a real, dense array of numbers with two or three dimensions
  bool cells = false;
  std::vector<std::string> fields{};  // of a structure
  std::string shown() const;          // "name (100 x 12)"
};

using MatVariables = std::vector<MatVariable>;

// The variable of that name; nullptr: there is none.
const MatVariable* find(const MatVariables& variables, std::string_view name);

struct MatFile {
  MatVariables variables;                 // all of the file
  std::map<std::string, MatArray> array;  // those that were asked for; of structures "trx(2).x", elements counted from 1
};

// Reads the variables whose names choose(all variables) returns. The work is done in a child process, because matio and HDF5 can crash
// on damaged files. `name` is for messages. Throws InputError when the bytes are no sound MAT file, or what `choose` throws.
MatFile read_mat_file(const std::string& name, std::string_view bytes,
                      const std::function<std::vector<std::string>(const MatVariables&)>& choose);

}  // namespace swarmfit
