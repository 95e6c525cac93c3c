// SPDX-License-Identifier: MIT
#include "tests/track/hdf5_make.h"

#include <cstdint>
#include <cstring>

namespace swarmfit {
namespace {

hid_t with_groups() {
  const hid_t plist = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(plist, 1);
  return plist;
}

// Variable length, UTF-8, as h5py and PyTables write it.
hid_t text_type() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

void write_attribute(hid_t file, const std::string& path, const std::string& name, hid_t type, hid_t space, const void* value) {
  const hid_t object = H5Oopen(file, path.c_str(), H5P_DEFAULT);
  const hid_t attribute = H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(attribute, type, value);
  H5Aclose(attribute);
  H5Oclose(object);
  H5Sclose(space);
}

void write_dataset(hid_t file, const std::string& path, hid_t type, const std::vector<hsize_t>& dims, const void* values) {
  const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), links = with_groups();
  const hid_t dataset = H5Dcreate2(file, path.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(dataset);
  H5Pclose(links);
  H5Sclose(space);
}

}  // namespace

MadeHdf5::MadeHdf5(hsize_t user_block) {
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  const hid_t creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(creation, user_block);
  H5Pset_fapl_core(access, 1 << 16, false);
  file_ = H5Fcreate(std::to_string(reinterpret_cast<std::uintptr_t>(this)).c_str(), H5F_ACC_TRUNC, creation, access);
  H5Pclose(creation);
  H5Pclose(access);
}

MadeHdf5::~MadeHdf5() { H5Fclose(file_); }

MadeHdf5& MadeHdf5::numbers(const std::string& path, const std::vector<hsize_t>& dims, const std::vector<double>& values) {
  write_dataset(file_, path, H5T_NATIVE_DOUBLE, dims, values.data());
  return *this;
}

MadeHdf5& MadeHdf5::texts(const std::string& path, const std::vector<std::string>& values) {
  std::vector<const char*> letters;
  for (const auto& value : values) letters.push_back(value.c_str());
  const hid_t type = text_type();
  write_dataset(file_, path, type, {values.size()}, letters.data());
  H5Tclose(type);
  return *this;
}

MadeHdf5& MadeHdf5::attribute(const std::string& path, const std::string& name, double value) {
  write_attribute(file_, path, name, H5T_NATIVE_DOUBLE, H5Screate(H5S_SCALAR), &value);
  return *this;
}

MadeHdf5& MadeHdf5::attribute(const std::string& path, const std::string& name, const std::string& value) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, value.size() + 1);
  write_attribute(file_, path, name, type, H5Screate(H5S_SCALAR), value.c_str());
  H5Tclose(type);
  return *this;
}

MadeHdf5& MadeHdf5::attribute(const std::string& path, const std::string& name, const std::vector<std::string>& values) {
  std::vector<const char*> letters;
  for (const auto& value : values) letters.push_back(value.c_str());
  const hid_t type = text_type();
  const hsize_t count = values.size();
  write_attribute(file_, path, name, type, H5Screate_simple(1, &count, nullptr), letters.data());
  H5Tclose(type);
  return *this;
}

MadeHdf5& MadeHdf5::table(const std::string& path, const std::vector<Column>& columns) {
  std::size_t size = 0;
  for (const auto& column : columns) size += column.width * sizeof(double);
  const std::size_t rows = columns[0].values.size() / columns[0].width;
  std::vector<char> bytes(rows * size);
  const hid_t type = H5Tcreate(H5T_COMPOUND, size);
  std::size_t offset = 0;
  for (const auto& column : columns) {
    const bool whole = column.name.back() == ':';
    const auto name = whole ? column.name.substr(0, column.name.size() - 1) : column.name;
    const hid_t one = whole ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE;
    const hid_t member = column.width > 1 ? H5Tarray_create2(one, 1, &column.width) : H5Tcopy(one);
    H5Tinsert(type, name.c_str(), offset, member);
    H5Tclose(member);
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      char* to = bytes.data() + i / column.width * size + offset + i % column.width * sizeof(double);
      const auto integer = static_cast<std::int64_t>(column.values[i]);
      std::memcpy(to, whole ? static_cast<const void*>(&integer) : &column.values[i], sizeof(double));
    }
    offset += column.width * sizeof(double);
  }
  write_dataset(file_, path, type, {rows}, bytes.data());
  H5Tclose(type);
  return *this;
}

std::string MadeHdf5::bytes() const {
  H5Fflush(file_, H5F_SCOPE_GLOBAL);
  const auto size = H5Fget_file_image(file_, nullptr, 0);
  std::string out(static_cast<std::size_t>(size), '\0');
  H5Fget_file_image(file_, out.data(), out.size());
  return out;
}

}  // namespace swarmfit
