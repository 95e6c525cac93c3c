// SPDX-License-Identifier: MIT
#include "libtrack/mat_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

struct Free {
  void operator()(matvar_t* v) const { Mat_VarFree(v); }
};
using Variable = std::unique_ptr<matvar_t, Free>;

// deflate cannot do better than this; a variable that claims more than the file could hold is a lie.
constexpr double kBestCompression = 1032;

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

MatVariable described(const matvar_t& v) {
  MatVariable out;
  out.name = v.name ? v.name : "";
  for (int i = 0; i < v.rank && v.dims; ++i) out.dims.push_back(v.dims[i]);
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

}  // namespace

// matio opens files by name only. The bytes are given a name in memory, so that what is parsed is what was hashed, and standard input
// works like a file.
struct MatFile::Handle {
  int fd = -1;
  mat_t* mat = nullptr;
  explicit Handle(std::string_view bytes) : fd(::memfd_create("swarmfit-mat", MFD_CLOEXEC)) {
    while (fd >= 0 && !bytes.empty()) {
      const ssize_t n = ::write(fd, bytes.data(), bytes.size());
      if (n <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    if (fd >= 0) mat = Mat_Open(fmt::format("/proc/self/fd/{}", fd).c_str(), MAT_ACC_RDONLY);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (mat) Mat_Close(mat);
    if (fd >= 0) ::close(fd);
  }
};

std::string MatVariable::shown() const { return fmt::format("{} ({})", name, fmt::join(dims, " x ")); }

MatFile::MatFile(std::string name, std::string_view bytes)
    : name_(std::move(name)), size_(bytes.size()), handle_(std::make_unique<Handle>(bytes)) {
  if (!handle_->mat) throw InputError(name_ + ": the MATLAB file cannot be opened; expected an undamaged file of version 5 or 7.3");
  while (const auto info = Variable(Mat_VarReadNextInfo(handle_->mat))) variables_.push_back(described(*info));
}

MatFile::~MatFile() = default;

const MatVariable* MatFile::find(std::string_view variable) const {
  const auto hit = std::find_if(variables_.begin(), variables_.end(), [&](const auto& v) { return v.name == variable; });
  return hit == variables_.end() ? nullptr : &*hit;
}

MatArray MatFile::read(const MatVariable& variable) const {
  const auto fail = [&](const std::string& what) -> InputError {
    return InputError(fmt::format("{}: variable '{}' {}", name_, variable.name, what));
  };
  if (!variable.numeric) throw fail("is not a real array of numbers; expected a table or a three-dimensional array");
  double count = 1;
  for (const auto n : variable.dims) count *= static_cast<double>(n);
  if (count > kBestCompression * static_cast<double>(size_))
    throw fail(fmt::format("claims {} values, more than a file of {} bytes can hold; expected an undamaged file",
                           fmt::join(variable.dims, " x "), size_));

  const Variable data(Mat_VarRead(handle_->mat, variable.name.c_str()));
  const auto expected = static_cast<std::size_t>(count);
  const bool complete = data && data->data && data->rank == static_cast<int>(variable.dims.size()) &&
                        std::equal(variable.dims.begin(), variable.dims.end(), data->dims) && is_number_class(data->class_type) &&
                        !data->isComplex && data->data_size > 0 && data->nbytes / static_cast<std::size_t>(data->data_size) >= expected;
  if (!complete) throw fail("cannot be read; expected an undamaged file");
  MatArray out{variable.dims, std::vector<double>(expected)};
  convert(*data, out.value);
  return out;
}

}  // namespace swarmfit
