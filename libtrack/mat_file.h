// SPDX-License-Identifier: MIT
// MATLAB files through matio, with every size checked before memory is taken.
#pragma once

#include <memory>
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
  bool numeric = false;       // a real, dense array of numbers
  std::string shown() const;  // "name (100 x 12)"
};

class MatFile {
 public:
  // Throws InputError when the bytes are no MAT file. `name` is for messages.
  MatFile(std::string name, std::string_view bytes);
  ~MatFile();
  const std::vector<MatVariable>& variables() const { return variables_; }
  const MatVariable* find(std::string_view variable) const;  // nullptr: there is none
  MatArray read(const MatVariable& variable) const;          // throws InputError

 private:
  struct Handle;
  std::string name_;
  std::size_t size_;
  std::unique_ptr<Handle> handle_;
  std::vector<MatVariable> variables_;
};

}  // namespace swarmfit
