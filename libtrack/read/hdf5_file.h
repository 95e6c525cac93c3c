// SPDX-License-Identifier: MIT
// HDF5 files as plain values. All work is done in a child process, because HDF5 can crash on damaged files; every size is checked before
// memory is taken, and a file that points outside of itself (external links, external storage, virtual datasets) is refused.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

struct Hdf5Attribute {
  std::string name;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

// A group or dataset, by its path from the root: "/processing/behavior".
struct Hdf5Object {
  enum class Kind : std::size_t { group, numbers, text, compound, other };
  std::string path;
  Kind kind = Kind::other;
  std::vector<std::size_t> dims;     // of a dataset
  std::vector<std::string> members;  // of a compound type
  std::vector<Hdf5Attribute> attributes;

  const Hdf5Attribute* attribute(std::string_view name) const;
  std::optional<double> number(std::string_view attribute) const;  // its first number
  std::string text(std::string_view attribute) const;              // its first text; empty: none
  std::string shown() const;                                       // "/tracks (3 x 2 x 601)"
};

struct Hdf5Contents {
  std::vector<Hdf5Object> objects;  // the root is "/"; in the order of the file's names
  const Hdf5Object* find(std::string_view path) const;
};

// Throws InputError when the bytes are no sound HDF5 file.
Hdf5Contents list_hdf5(const std::string& name, std::string_view bytes);

// A dataset, row-major, or one member of a compound dataset (a member that is an array adds a dimension).
struct Hdf5Request {
  std::string path, member{};
};
struct Hdf5Array {
  std::vector<std::size_t> dims;
  std::vector<double> numbers;
  std::vector<std::string> texts;
};

// One array per request. Throws InputError when one is not there, holds neither numbers nor text, or claims more than the file can hold.
std::vector<Hdf5Array> read_hdf5(const std::string& name, std::string_view bytes, const std::vector<Hdf5Request>& requests);

// Throws InputError when HDF5 bytes point outside of their file. For use in a child process, before another library reads them.
void check_hdf5_stands_alone(const std::string& name, std::string_view bytes);

}  // namespace swarmfit
