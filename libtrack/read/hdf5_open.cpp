// SPDX-License-Identifier: MIT
#include "libtrack/read/hdf5_open.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "libtrack/error.h"
#include "libtrack/read/deflate.h"

namespace swarmfit {
namespace {

constexpr std::size_t kMostObjects = 100'000, kMostAttribute = 1 << 20;

// A handle of the library with the function that closes it.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): it stands for the number
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

Handle type_handle(hid_t id) { return {id, H5Tclose}; }
Handle space_handle(hid_t id) { return {id, H5Sclose}; }

std::vector<std::size_t> extent(hid_t space) {
  std::array<hsize_t, H5S_MAX_RANK> dims{};
  const int rank = H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  std::vector<std::size_t> out;
  for (int i = 0; i < rank; ++i) out.push_back(dims[static_cast<std::size_t>(i)]);
  return out;
}

bool is_number(H5T_class_t c) { return c == H5T_INTEGER || c == H5T_FLOAT || c == H5T_ENUM; }

// Element counts multiplied without overflow.
double product(const std::vector<std::size_t>& dims) {
  double n = 1;
  for (const auto d : dims) n *= static_cast<double>(d);
  return n;
}

// Up to the first NUL, which ends texts of fixed length, too.
std::string cut(const char* text, std::size_t most) { return {text, strnlen(text, most)}; }

// Texts of fixed or variable length; read(memory type, buffer) is H5Dread or H5Aread.
template <class Read>
bool read_texts(hid_t type, hid_t space, std::size_t count, Read&& read, std::vector<std::string>& out) {
  if (count == 0) return true;
  const Handle memory = type_handle(H5Tcopy(type));
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> texts(count, nullptr);
    if (read(memory, static_cast<void*>(texts.data())) < 0) return false;
    for (const char* text : texts) out.emplace_back(text ? text : "");
    H5Dvlen_reclaim(memory, space, H5P_DEFAULT, texts.data());
    return true;
  }
  const std::size_t length = H5Tget_size(type);
  std::vector<char> letters(count * length);
  if (read(memory, static_cast<void*>(letters.data())) < 0) return false;
  for (std::size_t i = 0; i < count; ++i) out.push_back(cut(letters.data() + i * length, length));
  return true;
}

// Attributes that hold neither numbers nor text, or much, are left out.
Hdf5Attribute read_attribute(hid_t attribute) {
  Hdf5Attribute out;
  std::array<char, 256> name{};
  H5Aget_name(attribute, name.size(), name.data());
  out.name = name.data();
  const Handle type = type_handle(H5Aget_type(attribute)), space = space_handle(H5Aget_space(attribute));
  const auto kind = H5Tget_class(type);
  if (H5Sget_simple_extent_type(space) == H5S_NULL) return out;
  const double count = product(extent(space));
  if (count * static_cast<double>(H5Tget_size(type)) > static_cast<double>(kMostAttribute)) return out;
  const auto n = static_cast<std::size_t>(count);
  const auto read = [&](hid_t memory, void* to) { return H5Aread(attribute, memory, to); };
  if (is_number(kind)) {
    out.numbers.resize(n);
    if (n > 0 && read(H5T_NATIVE_DOUBLE, out.numbers.data()) < 0) out.numbers.clear();
  } else if (kind == H5T_STRING) {
    if (!read_texts(type, space, n, read, out.texts)) out.texts.clear();
  }
  return out;
}

std::vector<Hdf5Attribute> read_attributes(hid_t object) {
  std::vector<Hdf5Attribute> out;
  H5O_info_t info;
  if (H5Oget_info2(object, &info, H5O_INFO_NUM_ATTRS) < 0) return out;
  for (hsize_t i = 0; i < std::min<hsize_t>(info.num_attrs, 1000); ++i) {
    const Handle attribute(H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC, i, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (attribute.valid()) out.push_back(read_attribute(attribute));
  }
  return out;
}

Hdf5Object::Kind kind_of(hid_t type) {
  const auto c = H5Tget_class(type);
  if (is_number(c)) return Hdf5Object::Kind::numbers;
  if (c == H5T_STRING) return Hdf5Object::Kind::text;
  return c == H5T_COMPOUND ? Hdf5Object::Kind::compound : Hdf5Object::Kind::other;
}

void describe_dataset(hid_t dataset, Hdf5Object& out) {
  const Handle type = type_handle(H5Dget_type(dataset)), space = space_handle(H5Dget_space(dataset));
  out.kind = kind_of(type);
  out.dims = extent(space);
  if (out.kind != Hdf5Object::Kind::compound) return;
  for (int i = 0; i < H5Tget_nmembers(type); ++i) {
    char* name = H5Tget_member_name(type, static_cast<unsigned>(i));
    out.members.emplace_back(name ? name : "");
    H5free_memory(name);
  }
}

struct Visit {
  std::vector<std::string> paths;
  std::string outside;  // path of a link that leaves the file
};

// Hard links everywhere; soft links, which H5Lvisit does not follow, for what they are.
herr_t visit_link(hid_t, const char* path, const H5L_info_t* info, void* to) {
  auto& visit = *static_cast<Visit*>(to);
  if (info->type != H5L_TYPE_HARD && info->type != H5L_TYPE_SOFT) visit.outside = path;
  visit.paths.push_back(fmt::format("/{}", path));
  return visit.paths.size() > kMostObjects || !visit.outside.empty() ? 1 : 0;
}

// Another file's bytes behind a dataset.
bool stored_elsewhere(hid_t dataset) {
  const Handle plist(H5Dget_create_plist(dataset), H5Pclose);
  return H5Pget_external_count(plist) != 0 || H5Pget_layout(plist) == H5D_VIRTUAL;
}

std::string unknown_filter(hid_t dataset) {
  const Handle plist(H5Dget_create_plist(dataset), H5Pclose);
  for (int i = 0; i < H5Pget_nfilters(plist); ++i) {
    std::array<char, 64> name{};
    std::size_t n = 0;
    unsigned flags = 0, config = 0;
    const auto filter = H5Pget_filter2(plist, static_cast<unsigned>(i), &flags, &n, nullptr, name.size(), name.data(), &config);
    if (H5Zfilter_avail(filter) <= 0) return fmt::format("{} {}", static_cast<int>(filter), name.data());
  }
  return {};
}

// Elements of one chunk, which the library holds in memory at a time.
double chunk(hid_t dataset) {
  const Handle plist(H5Dget_create_plist(dataset), H5Pclose);
  if (H5Pget_layout(plist) != H5D_CHUNKED) return 0;
  std::array<hsize_t, H5S_MAX_RANK> dims{};
  const int rank = H5Pget_chunk(plist, static_cast<int>(dims.size()), dims.data());
  return product({dims.begin(), dims.begin() + std::max(rank, 0)});
}

template <class Read>
bool read_numbers(hid_t memory, Read&& read, Hdf5Array& out) {
  out.numbers.resize(static_cast<std::size_t>(product(out.dims)));
  return out.numbers.empty() || read(memory, out.numbers.data()) >= 0;
}

// One member of a table; if it is an array itself, its dimensions follow those of the table.
template <class Read, class Fail>
bool read_member(hid_t type, const std::string& name, double limit, Read&& read, Fail&& fail, Hdf5Array& out) {
  const int index = H5Tget_class(type) == H5T_COMPOUND ? H5Tget_member_index(type, name.c_str()) : -1;
  if (index < 0) throw fail(fmt::format("has no member '{}'; expected a table that has", name));
  const Handle member = type_handle(H5Tget_member_type(type, static_cast<unsigned>(index)));
  const bool array = H5Tget_class(member) == H5T_ARRAY;
  const Handle base = type_handle(array ? H5Tget_super(member) : H5Tcopy(member));
  if (!is_number(H5Tget_class(base))) throw fail(fmt::format("member '{}' holds no numbers; expected numbers", name));
  std::array<hsize_t, H5S_MAX_RANK> dims{};
  const int rank = array ? H5Tget_array_dims2(member, dims.data()) : 0;
  if (rank < 0) return false;
  out.dims.insert(out.dims.end(), dims.begin(), dims.begin() + rank);
  if (product(out.dims) * static_cast<double>(H5Tget_size(base)) > limit) return false;
  const Handle element =
      type_handle(array ? H5Tarray_create2(H5T_NATIVE_DOUBLE, static_cast<unsigned>(rank), dims.data()) : H5Tcopy(H5T_NATIVE_DOUBLE));
  const Handle memory = type_handle(H5Tcreate(H5T_COMPOUND, H5Tget_size(element)));
  H5Tinsert(memory, name.c_str(), 0, element);
  return read_numbers(memory, read, out);
}

}  // namespace

OpenHdf5::OpenHdf5(const std::string& name, std::string_view bytes) : name_(name), size_(bytes.size()), file_(-1) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // or HDF5 prints its own view of a damaged file to the terminal
  H5PLset_loading_state(0);                     // no file makes us load code
  H5Lunregister(H5L_TYPE_EXTERNAL);             // no file makes us open another
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, 1 << 16, false);
  H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());  // copies
  file_ = H5Fopen("/dev/null/image", H5F_ACC_RDONLY, access);  // a name that no file can have: one that is there would be opened
  if (file_ < 0) throw InputError(name + ": the HDF5 file cannot be read; expected an undamaged file");
  Visit visit;
  visit.paths.emplace_back("/");
  const bool walked = H5Lvisit(file_, H5_INDEX_NAME, H5_ITER_INC, visit_link, &visit) >= 0;
  if (!visit.outside.empty())
    throw InputError(fmt::format("{}: /{} is a link to another file; expected everything in one file", name, visit.outside));
  if (!walked) throw InputError(name + ": the HDF5 file cannot be read; expected an undamaged file");
  if (visit.paths.size() > kMostObjects)
    throw InputError(fmt::format("{}: it holds more than {} objects; expected a recording", name, kMostObjects));
  paths_ = std::move(visit.paths);
  refuse_outside(paths_);
}

OpenHdf5::~OpenHdf5() {
  if (file_ >= 0) H5Fclose(file_);
}

void OpenHdf5::refuse_outside(const std::vector<std::string>& paths) const {
  for (const auto& path : paths) {
    const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
    if (object.valid() && H5Iget_type(object) == H5I_DATASET && stored_elsewhere(object))
      throw InputError(fmt::format("{}: {} is stored in another file; expected everything in one file", name_, path));
  }
}

std::vector<Hdf5Object> OpenHdf5::list() const {
  std::vector<Hdf5Object> out;
  for (const auto& path : paths_) {
    const Handle object(H5Oopen(file_, path.c_str(), H5P_DEFAULT), H5Oclose);
    if (!object.valid()) continue;  // a soft link to nothing
    Hdf5Object entry;
    entry.path = path;
    if (H5Iget_type(object) == H5I_GROUP) entry.kind = Hdf5Object::Kind::group;
    if (H5Iget_type(object) == H5I_DATASET) describe_dataset(object, entry);
    entry.attributes = read_attributes(object);
    out.push_back(std::move(entry));
  }
  return out;
}

Hdf5Array OpenHdf5::read(const Hdf5Request& request) const {
  const auto fail = [&](const std::string& what) -> InputError { return InputError(fmt::format("{}: {} {}", name_, request.path, what)); };
  const Handle dataset(H5Dopen2(file_, request.path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) throw fail("is not there; expected a dataset of that name");
  const auto filter = unknown_filter(dataset);
  if (!filter.empty())
    throw fail(
        fmt::format("is compressed by the filter {}, which is not part of HDF5; expected gzip (h5repack -f GZIP=1 FILE NEW)", filter));

  const Handle type = type_handle(H5Dget_type(dataset)), space = space_handle(H5Dget_space(dataset));
  Hdf5Array out;
  out.dims = extent(space);
  const double size = static_cast<double>(H5Tget_size(type)), limit = kBestCompression * static_cast<double>(size_);
  if (product(out.dims) * size > limit || chunk(dataset) * size > limit)
    throw fail(fmt::format("claims {} values, more than a file of {} bytes can hold; expected an undamaged file",
                           fmt::join(out.dims, " x "), size_));
  const auto read = [&](hid_t memory, void* to) { return H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, to); };
  bool complete = false;
  if (!request.member.empty())
    complete = read_member(type, request.member, limit, read, fail, out);
  else if (is_number(H5Tget_class(type)))
    complete = read_numbers(H5T_NATIVE_DOUBLE, read, out);
  else if (H5Tget_class(type) == H5T_STRING)
    complete = read_texts(type, space, static_cast<std::size_t>(product(out.dims)), read, out.texts);
  else
    throw fail("holds neither numbers nor text; expected numbers");
  if (!complete) throw fail("cannot be read; expected an undamaged file");
  return out;
}

}  // namespace swarmfit
