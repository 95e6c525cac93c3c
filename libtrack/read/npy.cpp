// SPDX-License-Identifier: MIT
#include "libtrack/read/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>

#include "libtrack/error.h"
#include "libtrack/utf8.h"

namespace swarmfit {
namespace {

struct Header {
  NumberLayout layout;
  std::size_t data_at = 0;
};

// What follows 'key': in the header, which is a Python dict; blanks skipped.
std::string_view entry(std::string_view header, std::string_view key) {
  const auto found = header.find(key);
  if (found == std::string_view::npos) return {};
  header.remove_prefix(found + key.size());
  header.remove_prefix(std::min(header.find_first_not_of(" :"), header.size()));
  return header;
}

// "(100, 12)", "(7,)" or "()".
std::optional<std::vector<std::size_t>> shape(std::string_view text) {
  std::vector<std::size_t> dims;
  if (!text.starts_with('(')) return std::nullopt;
  text.remove_prefix(1);
  while (!text.starts_with(')')) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || dims.size() > 8) return std::nullopt;
    dims.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(", L"), text.size()));
    if (text.empty()) return std::nullopt;
  }
  return dims;
}

std::optional<Header> parse_header(std::string_view bytes) {
  if (bytes.size() < 12) return std::nullopt;
  const auto byte = [&](std::size_t i) { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i])); };
  const bool wide = bytes[6] >= 2;  // versions 2 and 3 give the length four bytes
  const std::size_t start = wide ? 12 : 10, length = byte(8) | byte(9) << 8 | (wide ? byte(10) << 16 | byte(11) << 24 : 0);
  if (bytes.size() - start < length) return std::nullopt;
  const auto text = bytes.substr(start, length);
  const auto type = entry(text, "'descr'");
  const auto dims = shape(entry(text, "'shape'"));
  if (!type.starts_with('\'') || !dims) return std::nullopt;
  return Header{{std::string(type.substr(1, type.find('\'', 1) - 1)), entry(text, "'fortran_order'").starts_with("True"), *dims},
                start + length};
}

template <class From>
void convert(std::string_view data, bool swap, std::vector<double>& out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    char raw[sizeof(From)];
    std::memcpy(raw, data.data() + i * sizeof(From), sizeof(From));
    if (swap) std::reverse(raw, raw + sizeof(From));
    From value;
    std::memcpy(&value, raw, sizeof(From));
    out[i] = static_cast<double>(value);
  }
}

using Convert = void (*)(std::string_view, bool, std::vector<double>&);

// The kind of number with its size in bytes.
Convert converter(std::string_view kind) {
  struct Kind {
    std::string_view name;
    Convert convert;
  };
  constexpr Kind kinds[] = {{"f8", convert<double>},        {"f4", convert<float>},         {"i8", convert<std::int64_t>},
                            {"i4", convert<std::int32_t>},  {"i2", convert<std::int16_t>},  {"i1", convert<std::int8_t>},
                            {"u8", convert<std::uint64_t>}, {"u4", convert<std::uint32_t>}, {"u2", convert<std::uint16_t>},
                            {"u1", convert<std::uint8_t>},  {"b1", convert<std::uint8_t>}};
  for (const auto& k : kinds)
    if (k.name == kind) return k.convert;
  return nullptr;
}

// From the first index running fastest to the last.
std::vector<double> row_major(const std::vector<double>& from, const std::vector<std::size_t>& dims) {
  std::vector<double> out(from.size());
  std::vector<std::size_t> index(dims.size(), 0);
  for (double& value : out) {
    std::size_t at = 0;
    for (std::size_t d = dims.size(); d-- > 0;) at = at * dims[d] + index[d];
    value = from[at];
    for (std::size_t d = dims.size(); d-- > 0 && ++index[d] == dims[d];) index[d] = 0;
  }
  return out;
}

bool holds_objects(const NumberLayout& layout) { return layout.type.size() < 3 || layout.type.find('O') != std::string::npos; }

InputError fault(const std::string& file, const std::string& name, const std::string& what) {
  return InputError(fmt::format("{}: {}{}", file, name.empty() ? "" : fmt::format("array '{}' ", name), what));
}

}  // namespace

std::string NumberArray::shown() const { return fmt::format("{} ({})", name, fmt::join(dims, " x ")); }

NumberArray numbers_of(const std::string& file, const std::string& name, const NumberLayout& layout, std::string_view data) {
  const auto convert = converter(std::string_view(layout.type).substr(std::min<std::size_t>(1, layout.type.size())));
  if (!convert) throw fault(file, name, fmt::format("is of type '{}'; expected real numbers", plain_name(layout.type.substr(0, 20))));
  double count = 1;
  for (const auto d : layout.dims) count *= static_cast<double>(d);
  const auto width = static_cast<double>(layout.type[2] - '0');
  if (count * width > static_cast<double>(data.size()))
    throw fault(file, name,
                fmt::format("claims {} numbers, more than are there; expected an undamaged file", fmt::join(layout.dims, " x ")));
  NumberArray out{name, layout.dims, std::vector<double>(static_cast<std::size_t>(count))};
  convert(data, layout.type[0] == '>', out.value);
  if (layout.fortran && out.dims.size() > 1) out.value = row_major(out.value, out.dims);
  return out;
}

bool is_number_type(std::string_view kind) { return converter(kind) != nullptr; }

std::string_view npy_pickle(std::string_view bytes) {
  const auto header = is_npy(bytes) ? parse_header(bytes) : std::nullopt;
  return header && holds_objects(header->layout) ? bytes.substr(header->data_at) : std::string_view();
}

NumberArray parse_npy(const std::string& file, const std::string& name, std::string_view bytes) {
  const auto header = is_npy(bytes) ? parse_header(bytes) : std::nullopt;
  if (!header) throw fault(file, name, "has no header of a NumPy array of numbers; expected one");
  if (holds_objects(header->layout))
    throw fault(file, name,
                "is a Python pickle; expected numbers (in Python: load it with numpy.load(FILE, allow_pickle=True) and save rows of "
                "id,frame,x,y as CSV)");
  return numbers_of(file, name, header->layout, bytes.substr(header->data_at));
}

bool is_npy_text(std::string_view bytes) {
  const auto header = is_npy(bytes) ? parse_header(bytes) : std::nullopt;
  return header && header->layout.type.starts_with("<U");
}

std::vector<std::string> parse_npy_texts(const std::string& file, const std::string& name, std::string_view bytes) {
  const auto fail = [&](const std::string& what) { return InputError(fmt::format("{}: array '{}' {}", file, name, what)); };
  const auto header = is_npy(bytes) ? parse_header(bytes) : std::nullopt;
  if (!header || !header->layout.type.starts_with("<U")) throw fail("holds no texts; expected type '<U'");
  std::size_t length = 0;
  const std::string& type = header->layout.type;
  const char* end = type.data() + type.size();
  if (std::from_chars(type.data() + 2, end, length).ptr != end) throw fail("has no length; expected type '<U'");
  const auto data = bytes.substr(header->data_at);
  double count = 1;
  for (const auto d : header->layout.dims) count *= static_cast<double>(d);
  if (count * std::max(1.0, 4 * static_cast<double>(length)) > static_cast<double>(data.size()))
    throw fail("claims more texts than are there; expected an undamaged file");
  std::vector<std::string> out;
  std::u32string text(length, U'\0');
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (length > 0) std::memcpy(text.data(), data.data() + 4 * length * i, 4 * length);
    out.push_back(to_utf8(text.substr(0, text.find(U'\0'))));
  }
  return out;
}

}  // namespace swarmfit
