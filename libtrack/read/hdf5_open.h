// SPDX-License-Identifier: MIT
// An HDF5 file in memory, through the HDF5 library. For use in a child process only: opening it changes the library's global settings.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libtrack/read/hdf5_file.h"

namespace swarmfit {

class OpenHdf5 {
 public:
  // Throws InputError when the bytes are no HDF5 file, or one that points outside of itself.
  OpenHdf5(const std::string& name, std::string_view bytes);
  OpenHdf5(const OpenHdf5&) = delete;
  OpenHdf5& operator=(const OpenHdf5&) = delete;
  ~OpenHdf5();

  std::vector<Hdf5Object> list() const;
  Hdf5Array read(const Hdf5Request&) const;

 private:
  void refuse_outside(const std::vector<std::string>& paths) const;

  std::string name_;
  std::size_t size_;                // of the file [bytes]
  std::int64_t file_;               // the library's handle
  std::vector<std::string> paths_;  // of all objects, the root first
};

}  // namespace swarmfit
