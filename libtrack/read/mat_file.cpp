// SPDX-License-Identifier: MIT
#include "libtrack/read/mat_file.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <matio.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "libtrack/error.h"
#include "libtrack/isolated.h"
#include "libtrack/read/deflate.h"
#include "libtrack/read/hdf5_file.h"
#include "libtrack/read/mat_check.h"
#include "libtrack/read/packed.h"

namespace swarmfit {
namespace {

struct Free {
  void operator()(matvar_t* v) const { Mat_VarFree(v); }
};
using Variable = std::unique_ptr<matvar_t, Free>;

bool is_number_class(matio_classes c) {
  switch (c) {
    case MAT_C_DOUBLE:
    case MAT_C_SINGLE:
    case MAT_C_INT8:
    case MAT_C_UINT8:
    case MAT_C_INT16:
    case MAT_C_UINT16:
    case MAT_C_INT32:
    case MAT_C_UINT32:
    case MAT_C_INT64:
    case MAT_C_UINT64:
      return true;
    default:
      return false;
  }
}

MatVariable described(matvar_t& v) {
  MatVariable out;
  out.name = v.name ? v.name : "";
  for (int i = 0; i < v.rank && v.dims; ++i) out.dims.push_back(v.dims[i]);
  out.cells = v.class_type == MAT_C_CELL;
  if (v.class_type == MAT_C_STRUCT) {
    const auto* names = Mat_VarGetStructFieldnames(&v);
    for (unsigned i = 0; names && i < Mat_VarGetNumberOfFields(&v); ++i) out.fields.emplace_back(names[i] ? names[i] : "");
  }
  out.numeric = is_number_class(v.class_type) && !v.isComplex && v.rank >= 2 && v.rank <= 3;
  return out;
}

template <class From>
void convert(const matvar_t& v, std::vector<double>& out) {
  const auto* from = static_cast<const From*>(v.data);
  std::transform(from, from + out.size(), out.begin(), [](From value) { return static_cast<double>(value); });
}

// matio converts the stored type to the class when it reads.
void convert(const matvar_t& v, std::vector<double>& out) {
  switch (v.class_type) {
    case MAT_C_DOUBLE:
      return convert<double>(v, out);
    case MAT_C_SINGLE:
      return convert<float>(v, out);
    case MAT_C_INT8:
      return convert<mat_int8_t>(v, out);
    case MAT_C_UINT8:
      return convert<mat_uint8_t>(v, out);
    case MAT_C_INT16:
      return convert<mat_int16_t>(v, out);
    case MAT_C_UINT16:
      return convert<mat_uint16_t>(v, out);
    case MAT_C_INT32:
      return convert<mat_int32_t>(v, out);
    case MAT_C_UINT32:
      return convert<mat_uint32_t>(v, out);
    case MAT_C_INT64:
      return convert<mat_int64_t>(v, out);
    case MAT_C_UINT64:
      return convert<mat_uint64_t>(v, out);
    default:
      break;
  }
}

// matio opens files by name only. The bytes get a name until the file is open, so that what is parsed is what was hashed, and standard
// input works like a file.
class OpenMat {
 public:
  explicit OpenMat(std::string_view bytes) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // or HDF5 prints its own view of a damaged file to the terminal
    for (const auto* folder : {"/tmp", "/var/tmp", "/dev/shm"}) {
      std::string path = std::string(folder) + "/swarmfit-XXXXXX";
      const int fd = ::mkstemp(path.data());
      if (fd < 0) continue;
      const bool written = write_all(fd, bytes);
      ::close(fd);
      if (written) mat_ = Mat_Open(path.c_str(), MAT_ACC_RDONLY);
      ::unlink(path.c_str());
      if (written) return;
    }
    throw RunError("no temporary file can be written in /tmp, /var/tmp or /dev/shm, and MATLAB files need one");
  }
  OpenMat(const OpenMat&) = delete;
  OpenMat& operator=(const OpenMat&) = delete;
  ~OpenMat() {
    if (mat_) Mat_Close(mat_);
  }
  mat_t* get() const { return mat_; }

 private:
  static bool write_all(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::write(fd, bytes.data(), bytes.size());
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }

  mat_t* mat_ = nullptr;
};

MatArray read_variable(mat_t* mat, const MatVariable& variable, const std::string& file, std::size_t file_size) {
  const auto fail = [&](const std::string& what) -> InputError {
    return InputError(fmt::format("{}: variable '{}' {}", file, variable.name, what));
  };
  if (!variable.numeric) throw fail("is not a real array of numbers; expected a table or a three-dimensional array");
  double count = 1;
  for (const auto n : variable.dims) count *= static_cast<double>(n);
  if (count > kBestCompression * static_cast<double>(file_size))
    throw fail(fmt::format("claims {} values, more than a file of {} bytes can hold; expected an undamaged file",
                           fmt::join(variable.dims, " x "), file_size));

  const Variable data(Mat_VarRead(mat, variable.name.c_str()));
  const auto expected = static_cast<std::size_t>(count);
  const bool complete = data && data->data && data->rank == static_cast<int>(variable.dims.size()) &&
                        std::equal(variable.dims.begin(), variable.dims.end(), data->dims) && is_number_class(data->class_type) &&
                        !data->isComplex && data->data_size > 0 && data->nbytes / static_cast<std::size_t>(data->data_size) >= expected;
  if (!complete) throw fail("cannot be read; expected an undamaged file");
  MatArray out{variable.dims, std::vector<double>(expected)};
  convert(*data, out.value);
  return out;
}

// All fields of all elements that are real arrays of numbers. The library reads a structure as a whole; the child's memory is limited.
void read_structure(mat_t* mat, const MatVariable& variable, const std::string& file, std::map<std::string, MatArray>& out) {
  const Variable data(Mat_VarRead(mat, variable.name.c_str()));
  if (!data || data->class_type != MAT_C_STRUCT)
    throw InputError(fmt::format("{}: structure '{}' cannot be read; expected an undamaged file", file, variable.name));
  std::size_t count = 1;
  for (const auto d : variable.dims) count *= d;
  for (std::size_t i = 0; i < count; ++i) {
    for (const auto& name : variable.fields) {
      matvar_t* field = Mat_VarGetStructFieldByName(data.get(), name.c_str(), i);
      if (!field || !field->data || !described(*field).numeric || field->data_size <= 0) continue;
      MatArray array{described(*field).dims, std::vector<double>(field->nbytes / static_cast<std::size_t>(field->data_size))};
      convert(*field, array.value);
      out.emplace(fmt::format("{}({}).{}", variable.name, i + 1, name), std::move(array));
    }
  }
}

std::string pack(const MatFile& file) {
  Packer out;
  out.add(file.variables.size());
  for (const auto& v : file.variables) {
    out.add(v.name);
    out.add(v.dims);
    out.add(static_cast<std::size_t>(v.numeric));
    out.add(static_cast<std::size_t>(v.cells));
    out.add(v.fields);
  }
  out.add(file.array.size());
  for (const auto& [name, array] : file.array) {
    out.add(name);
    out.add(array.dims);
    out.add(array.value);
  }
  return std::move(out.bytes);
}

MatFile unpack(std::string_view bytes) {
  Unpacker in(bytes);
  MatFile file;
  for (auto n = in.size(); n > 0; --n) {
    MatVariable v;
    v.name = in.text();
    v.dims = in.list<std::size_t>();
    v.numeric = in.size() != 0;
    v.cells = in.size() != 0;
    v.fields = in.texts();
    file.variables.push_back(std::move(v));
  }
  for (auto n = in.size(); n > 0; --n) {
    auto& array = file.array[in.text()];
    array.dims = in.list<std::size_t>();
    array.value = in.list<double>();
  }
  return file;
}

}  // namespace

std::string MatVariable::shown() const { return fmt::format("{} ({})", name, fmt::join(dims, " x ")); }

const MatVariable* find(const MatVariables& variables, std::string_view name) {
  const auto hit = std::find_if(variables.begin(), variables.end(), [&](const auto& v) { return v.name == name; });
  return hit == variables.end() ? nullptr : &*hit;
}

MatFile read_mat_file(const std::string& name, std::string_view bytes,
                      const std::function<std::vector<std::string>(const MatVariables&)>& choose) {
  if (bytes.starts_with("MATLAB 5.0")) check_mat5(name, bytes);
  const auto damaged = name + ": the MATLAB file cannot be read; expected an undamaged file of version 5 or 7.3";
  const auto work = [&] {
    if (!bytes.starts_with("MATLAB 5.0")) check_hdf5_stands_alone(name, bytes);
    const OpenMat mat(bytes);
    if (!mat.get()) throw InputError(damaged);
    MatFile file;
    while (const auto info = Variable(Mat_VarReadNextInfo(mat.get()))) file.variables.push_back(described(*info));
    if (file.variables.empty()) throw InputError(damaged);
    for (const auto& chosen : choose(file.variables)) {
      const auto* variable = find(file.variables, chosen);
      if (variable->fields.empty())
        file.array[chosen] = read_variable(mat.get(), *variable, name, bytes.size());
      else
        read_structure(mat.get(), *variable, name, file.array);
    }
    return pack(file);
  };
  const int seconds = 60 + static_cast<int>(bytes.size() / 1'000'000);  // a generous allowance: only endless loops need more
  return unpack(isolated(work, seconds, child_memory(bytes.size()), damaged));
}

}  // namespace swarmfit
