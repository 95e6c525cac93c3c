// SPDX-License-Identifier: MIT
// PLY 1.0, text or binary: elements with properties, of which x, y and z of `vertex` and the list vertex_indices (or vertex_index) of
// `face` are read.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "libswarm/scenario/mesh_file.h"
#include "libtrack/error.h"

namespace swarmfit {
namespace {

enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Order { text, little, big };

struct Property {
  std::string name;
  Type type{};
  bool list = false;
  Type count{};  // of a list
};
struct Element {
  std::string name;
  std::int64_t size = 0;
  std::vector<Property> properties;
};
struct Header {
  Order order{};
  std::vector<Element> elements;
};

Type type_of(const MeshLines& lines, std::string_view word) {
  static constexpr std::pair<std::string_view, Type> kNames[] = {
      {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
      {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
      {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
      {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& [name, type] : kNames)
    if (name == word) return type;
  lines.refuse(fmt::format("'{}' is not a type; expected one of PLY's, as int or float", MeshLines::shown(word)));
}

std::size_t size_of(Type type) {
  return type == Type::f64                                             ? 8
         : type == Type::i32 || type == Type::u32 || type == Type::f32 ? 4
         : type == Type::i16 || type == Type::u16                      ? 2
                                                                       : 1;
}

Property property_of(const MeshLines& lines) {
  const auto& words = lines.words();
  const bool list = words.size() == 5 && words[1] == "list";
  if (!list && words.size() != 3) lines.refuse("is not a property; expected property TYPE NAME, or property list TYPE TYPE NAME");
  Property p{std::string(words.back()), type_of(lines, words[words.size() - 2]), list};
  if (list) p.count = type_of(lines, words[2]);
  return p;
}

Header header_of(MeshLines& lines) {
  Header header;
  bool format = false;
  if (!lines.next() || lines.words()[0] != "ply") lines.refuse("no PLY; expected the word ply");
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "end_header") {
      if (!format) lines.refuse("no format before it; expected format ascii, binary_little_endian or binary_big_endian 1.0");
      return header;
    }
    if (words[0] == "format") {
      format = words.size() == 3 && (words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian");
      if (!format) lines.refuse("is not a format; expected format ascii, binary_little_endian or binary_big_endian 1.0");
      header.order = words[1] == "ascii" ? Order::text : words[1] == "binary_little_endian" ? Order::little : Order::big;
    } else if (words[0] == "element") {
      const std::int64_t size = lines.whole(2);
      if (size < 0 || size > 100'000'000) lines.refuse(fmt::format("{} elements; expected 0 to 1e8", size));
      header.elements.push_back({std::string(words[1]), size, {}});
    } else if (words[0] == "property") {
      if (header.elements.empty()) lines.refuse("a property of nothing; expected element before it");
      header.elements.back().properties.push_back(property_of(lines));
    }
  }
  lines.refuse("the file ends within its header; expected end_header");
}

// Values one after the other, from text or bytes.
class Values {
 public:
  Values(const std::string& name, MeshLines& lines, Order order) : name_(name), lines_(lines), bytes_(lines.rest()), order_(order) {}
  void begin() {
    if (order_ == Order::text && !lines_.next()) end();
    word_ = 0;
  }
  double next(Type type) {
    if (order_ == Order::text) return lines_.number(word_++);
    const std::size_t size = size_of(type);
    if (bytes_.size() < size) end();
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k) bits = bits << 8U | static_cast<unsigned char>(bytes_[order_ == Order::big ? k : size - 1 - k]);
    bytes_.remove_prefix(size);
    return value_of(type, bits);
  }
  [[noreturn]] void refuse(const std::string& what) const {
    if (order_ == Order::text) lines_.refuse(what);
    throw InputError(name_ + ": " + what);
  }

 private:
  static double value_of(Type type, std::uint64_t bits) {
    switch (type) {
      case Type::i8:
        return static_cast<std::int8_t>(bits);
      case Type::i16:
        return static_cast<std::int16_t>(bits);
      case Type::i32:
        return static_cast<std::int32_t>(bits);
      case Type::f32:
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      case Type::f64:
        return std::bit_cast<double>(bits);
      case Type::u8:
      case Type::u16:
      case Type::u32:
        break;
    }
    return static_cast<double>(bits);
  }
  [[noreturn]] void end() const {
    throw InputError(name_ + ": the file ends before its last element; expected as many as its header says");
  }

  std::string name_;
  MeshLines& lines_;
  std::string_view bytes_;
  Order order_;
  std::size_t word_ = 0;
};

std::size_t count_of(Values& values, const Property& p) {
  const double count = values.next(p.count);
  if (!(count >= 0 && count <= 1'000'000 && count == std::floor(count)))
    values.refuse(fmt::format("a list of {:g}; expected 0 to 1e6", count));
  return static_cast<std::size_t>(count);
}

void read_corner(Values& values, const Element& element, MeshText& mesh) {
  Eigen::Array3d place = Eigen::Array3d::Zero();
  for (const Property& p : element.properties) {
    for (std::size_t left = p.list ? count_of(values, p) : 1; left > 0; --left) {
      const double value = values.next(p.type);
      if (!p.list && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z') place[p.name[0] - 'x'] = value;
    }
  }
  mesh.corners.push_back(place);
}

void read_face(Values& values, const Element& element, MeshText& mesh, std::int64_t corners) {
  std::vector<std::uint32_t> face;
  for (const Property& p : element.properties) {
    const bool wanted = p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
    for (std::size_t left = p.list ? count_of(values, p) : 1; left > 0; --left) {
      const double value = values.next(p.type);
      if (!wanted) continue;
      if (!(value >= 0 && value < static_cast<double>(corners) && value == std::floor(value)))
        values.refuse(fmt::format("face {} has corner {:g}; expected 0 to {}", mesh.triangles.size(), value, corners - 1));
      face.push_back(static_cast<std::uint32_t>(value));
    }
  }
  if (face.size() < 3) values.refuse(fmt::format("a face of {} corners; expected three or more in vertex_indices", face.size()));
  add_face(mesh, face);
}

}  // namespace

MeshText read_ply(const std::string& name, std::string_view bytes) {
  MeshLines lines(name, bytes);
  const Header header = header_of(lines);
  MeshText mesh;
  std::int64_t corners = 0;
  for (const Element& element : header.elements) {
    if (element.size > 0 && element.properties.empty())
      throw InputError(fmt::format("{}: element {} has no property; expected some", name, MeshLines::shown(element.name)));
    if (element.name == "vertex") corners = element.size;
  }
  Values values(name, lines, header.order);
  for (const Element& element : header.elements)
    for (std::int64_t k = 0; k < element.size; ++k) {
      values.begin();
      if (element.name == "vertex")
        read_corner(values, element, mesh);
      else if (element.name == "face")
        read_face(values, element, mesh, corners);
      else
        for (const Property& p : element.properties)
          for (std::size_t left = p.list ? count_of(values, p) : 1; left > 0; --left) values.next(p.type);
    }
  return mesh;
}

}  // namespace swarmfit
