// SPDX-License-Identifier: MIT
#include "libtrack/read/hdf5_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "libtrack/error.h"
#include "libtrack/isolated.h"
#include "libtrack/read/hdf5_open.h"
#include "libtrack/read/packed.h"

namespace swarmfit {
namespace {

// In a child process; crashes and endless loops become one line.
std::string in_child(const std::string& name, std::string_view bytes, const std::function<std::string()>& work) {
  const int seconds = 60 + static_cast<int>(bytes.size() / 1'000'000);  // a generous allowance: only endless loops need more
  return isolated(work, seconds, child_memory(bytes.size()), name + ": the HDF5 file cannot be read; expected an undamaged file");
}

void pack(Packer& out, const Hdf5Object& object) {
  out.add(object.path);
  out.add(static_cast<std::size_t>(object.kind));
  out.add(object.dims);
  out.add(object.members);
  out.add(object.attributes.size());
  for (const auto& a : object.attributes) {
    out.add(a.name);
    out.add(a.numbers);
    out.add(a.texts);
  }
}

Hdf5Object unpack_object(Unpacker& in) {
  Hdf5Object object;
  object.path = in.text();
  object.kind = static_cast<Hdf5Object::Kind>(in.size());
  object.dims = in.list<std::size_t>();
  object.members = in.texts();
  object.attributes.resize(in.size());
  for (auto& a : object.attributes) {
    a.name = in.text();
    a.numbers = in.list<double>();
    a.texts = in.texts();
  }
  return object;
}

}  // namespace

const Hdf5Attribute* Hdf5Object::attribute(std::string_view name) const {
  const auto hit = std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.name == name; });
  return hit == attributes.end() ? nullptr : &*hit;
}

std::optional<double> Hdf5Object::number(std::string_view name) const {
  const auto* a = attribute(name);
  return a && !a->numbers.empty() ? std::optional(a->numbers[0]) : std::nullopt;
}

std::string Hdf5Object::text(std::string_view name) const {
  const auto* a = attribute(name);
  return a && !a->texts.empty() ? a->texts[0] : std::string();
}

std::string Hdf5Object::shown() const { return kind == Kind::group ? path : fmt::format("{} ({})", path, fmt::join(dims, " x ")); }

const Hdf5Object* Hdf5Contents::find(std::string_view path) const {
  const auto hit = std::find_if(objects.begin(), objects.end(), [&](const auto& o) { return o.path == path; });
  return hit == objects.end() ? nullptr : &*hit;
}

Hdf5Contents list_hdf5(const std::string& name, std::string_view bytes) {
  const auto packed = in_child(name, bytes, [&] {
    const OpenHdf5 file(name, bytes);
    const auto objects = file.list();
    Packer out;
    out.add(objects.size());
    for (const auto& object : objects) pack(out, object);
    return std::move(out.bytes);
  });
  Unpacker in(packed);
  Hdf5Contents contents;
  contents.objects.resize(in.size());
  for (auto& object : contents.objects) object = unpack_object(in);
  return contents;
}

std::vector<Hdf5Array> read_hdf5(const std::string& name, std::string_view bytes, const std::vector<Hdf5Request>& requests) {
  const auto packed = in_child(name, bytes, [&] {
    const OpenHdf5 file(name, bytes);
    Packer out;
    for (const auto& request : requests) {
      const Hdf5Array array = file.read(request);
      out.add(array.dims);
      out.add(array.numbers);
      out.add(array.texts);
    }
    return std::move(out.bytes);
  });
  Unpacker in(packed);
  std::vector<Hdf5Array> arrays(requests.size());
  for (auto& array : arrays) {
    array.dims = in.list<std::size_t>();
    array.numbers = in.list<double>();
    array.texts = in.texts();
  }
  return arrays;
}

void check_hdf5_stands_alone(const std::string& name, std::string_view bytes) { const OpenHdf5 file(name, bytes); }

}  // namespace swarmfit
