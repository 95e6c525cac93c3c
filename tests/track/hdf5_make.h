// SPDX-License-Identifier: MIT
// HDF5 files made in memory by the HDF5 library, for tests of what reads them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <hdf5.h>

namespace swarmfit {

class MadeHdf5 {
 public:
  explicit MadeHdf5(hsize_t user_block = 0);  // bytes to put in front, which HDF5 skips; bytes() lacks them
  MadeHdf5(const MadeHdf5&) = delete;
  MadeHdf5& operator=(const MadeHdf5&) = delete;
  ~MadeHdf5();

  // Groups on the way are created.
  MadeHdf5& numbers(const std::string& path, const std::vector<hsize_t>& dims, const std::vector<double>& values);
  MadeHdf5& texts(const std::string& path, const std::vector<std::string>& values);
  MadeHdf5& attribute(const std::string& path, const std::string& name, double value);
  MadeHdf5& attribute(const std::string& path, const std::string& name, const std::string& value);
  MadeHdf5& attribute(const std::string& path, const std::string& name, const std::vector<std::string>& values);

  // A table with columns of doubles, or of signed integers where the name ends with ':'; a column may be an array of `width` numbers.
  struct Column {
    std::string name;
    std::vector<double> values;
    hsize_t width = 1;
  };
  MadeHdf5& table(const std::string& path, const std::vector<Column>& columns);

  hid_t file() const { return file_; }
  std::string bytes() const;

 private:
  hid_t file_;
};

}  // namespace swarmfit
