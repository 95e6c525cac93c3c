// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>

#include "libtrack/error.h"
#include "libtrack/write/own_columns.h"
#include "libtrack/write/write.h"

namespace swarmfit {
namespace {

constexpr hsize_t kChunk = 1 << 16;
constexpr unsigned kCompression = 4;

// A handle of the library with the function that closes it; what cannot be made is a fault of this moment: no memory.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) { require(id >= 0); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close_(id_); }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for the number
  static void require(bool done) {
    if (!done) throw RunError("HDF5 cannot make the file in memory");
  }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// No times in the file: the same recording, the same bytes.
Handle plain_properties() {
  return {[] {
            const hid_t id = H5Pcreate(H5P_DATASET_CREATE);
            H5Pset_obj_track_times(id, false);
            return id;
          }(),
          H5Pclose};
}

void write_numbers(hid_t file, const std::string& name, const std::vector<double>& values, hid_t stored) {
  const hsize_t size = values.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose), properties = plain_properties();
  if (size > 0) {
    const hsize_t chunk = std::min(size, kChunk);
    H5Pset_chunk(properties, 1, &chunk);
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, kCompression);
  }
  const Handle data(H5Dcreate2(file, name.c_str(), stored, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  if (size > 0) Handle::require(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
}

Handle utf8() {
  return {[] {
            const hid_t id = H5Tcopy(H5T_C_S1);
            H5Tset_size(id, H5T_VARIABLE);
            H5Tset_cset(id, H5T_CSET_UTF8);
            return id;
          }(),
          H5Tclose};
}

void write_texts(hid_t file, const std::string& name, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const auto& text : texts) pointers.push_back(text.c_str());
  const hsize_t size = pointers.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose), type = utf8(), properties = plain_properties();
  const Handle data(H5Dcreate2(file, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  if (size > 0) Handle::require(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) >= 0);
}

void write_attribute(hid_t file, const char* name, const std::string& value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose), type = utf8();
  const Handle attribute(H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* text = value.c_str();
  Handle::require(H5Awrite(attribute, type, static_cast<const void*>(&text)) >= 0);
}

void write_attribute(hid_t file, const char* name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  Handle::require(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value) >= 0);
}

}  // namespace

std::string to_hdf5(const Tracks& tracks) {
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 20, false);
  const Handle file(H5Fcreate("/dev/null/image", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);  // in memory: nothing is written there
  const auto& meta = tracks.meta();
  write_attribute(file, "swarmfit", "tracks/1");
  write_attribute(file, "unit", meta.unit);
  write_attribute(file, "dt", meta.dt);
  write_attribute(file, "t0", meta.t0);
  write_attribute(file, "synthetic", meta.from.synthetic ? 1.0 : 0.0);
  write_texts(file, "names", tracks.names());
  write_texts(file, "notes", meta.from.notes);
  if (!meta.kinds.empty()) write_texts(file, "kinds", meta.kinds);
  write_numbers(file, "episodes", {tracks.episodes().begin(), tracks.episodes().end()}, H5T_STD_I64LE);
  for (const auto& [name, values] : own_columns(tracks))
    write_numbers(file, name, values, name == "track" || name == "frame" || name == "kind" ? H5T_STD_I64LE : H5T_IEEE_F64LE);
  Handle::require(H5Fflush(file, H5F_SCOPE_GLOBAL) >= 0);
  const auto size = H5Fget_file_image(file, nullptr, 0);
  Handle::require(size > 0);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  Handle::require(H5Fget_file_image(file, bytes.data(), bytes.size()) == size);
  return bytes;
}

}  // namespace swarmfit
