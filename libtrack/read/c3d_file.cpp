// SPDX-License-Identifier: MIT
#include "libtrack/read/c3d_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>

#include "libtrack/error.h"
#include "libtrack/nan.h"

namespace swarmfit {
namespace {

constexpr std::size_t kBlock = 512;
constexpr std::size_t kKey = 0x50;

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

// Texts are filled up with blanks.
std::string trimmed(std::string_view text) {
  text = text.substr(0, text.find('\0'));
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  return std::string(text);
}

int signed_byte(std::size_t byte) { return byte < 0x80 ? static_cast<int>(byte) : static_cast<int>(byte) - 0x100; }

// A VAX F float: the first word holds sign, exponent and the high bits, and the leading bit of the fraction stands for 1/2.
double dec_float(std::uint32_t high, std::uint32_t low) {
  const std::uint32_t sign = high >> 15, exponent = (high >> 7) & 0xFF, fraction = (high & 0x7F) << 16 | low;
  if (exponent == 0) return sign == 0 ? 0 : kNaN;
  const double size = std::ldexp(static_cast<double>(fraction | 0x800000), static_cast<int>(exponent) - 128 - 24);
  return sign == 0 ? size : -size;
}

}  // namespace

bool is_c3d(std::string_view bytes) {
  if (bytes.size() < 2 * kBlock || bytes[1] != static_cast<char>(kKey)) return false;
  const std::size_t block = static_cast<unsigned char>(bytes[0]);
  if (block < 2 || bytes.size() < block * kBlock) return false;
  const auto machine = static_cast<unsigned char>(bytes[(block - 1) * kBlock + 3]);
  return machine >= 84 && machine <= 86;
}

void C3dFile::damaged(const std::string& what) const { throw InputError(name_ + ": " + what); }

std::size_t C3dFile::byte(std::size_t at) const {
  if (at >= bytes_.size()) damaged(fmt::format("the file ends within its parameters; expected more than {} bytes", bytes_.size()));
  return static_cast<unsigned char>(bytes_[at]);
}

std::size_t C3dFile::word(std::size_t at) const {
  return machine_ == Machine::mips ? byte(at) << 8 | byte(at + 1) : byte(at + 1) << 8 | byte(at);
}

double C3dFile::number(std::size_t at) const {
  const auto first = static_cast<std::uint32_t>(word(at)), second = static_cast<std::uint32_t>(word(at + 2));
  if (machine_ == Machine::dec) return dec_float(first, second);
  return std::bit_cast<float>(machine_ == Machine::mips ? first << 16 | second : second << 16 | first);
}

// Type, dimensions and values; `at` ends behind them.
C3dParameter C3dFile::read_values(std::size_t& at) const {
  const std::size_t type = byte(at), dimensions = byte(at + 1);
  const std::size_t size = type == 0xFF ? 1 : type;
  if (size != 1 && size != 2 && size != 4) damaged(fmt::format("a parameter has values of type {}; expected -1, 1, 2 or 4", whole(type)));
  if (dimensions > 7) damaged(fmt::format("a parameter has {} dimensions; expected 7 at most", dimensions));
  at += 2;
  std::size_t count = 1;
  const std::size_t length = dimensions > 0 ? byte(at) : 1;
  for (std::size_t d = 0; d < dimensions; ++d) {
    count *= byte(at++);
    if (count > bytes_.size()) damaged("a parameter is larger than the file; expected smaller dimensions");
  }
  if (count * size > bytes_.size() - std::min(at, bytes_.size())) damaged("a parameter goes beyond the file; expected smaller dimensions");
  C3dParameter out;
  for (std::size_t i = 0; type != 0xFF && i < count; ++i)
    out.numbers.push_back(size == 4   ? number(at + 4 * i)
                          : size == 2 ? static_cast<double>(word(at + 2 * i))
                                      : static_cast<double>(byte(at + i)));
  for (std::size_t i = 0; type == 0xFF && length > 0 && i + length <= count; i += length)
    out.texts.push_back(trimmed(bytes_.substr(at + i, length)));
  at += count * size;
  return out;
}

// Groups have negative numbers, and their parameters the same as positive ones. A record ends with the distance to the next; 0: the last.
void C3dFile::read_parameters(std::size_t start) {
  const std::size_t blocks = std::max<std::size_t>(1, byte(start + 2));
  const std::size_t end = std::min(bytes_.size(), start + blocks * kBlock);
  std::map<int, std::string> groups;
  std::vector<std::pair<int, Named>> found;
  for (std::size_t at = start + 4; at + 4 <= end;) {
    const int stated = signed_byte(byte(at)), group = signed_byte(byte(at + 1));
    const auto length = static_cast<std::size_t>(std::abs(stated));  // negative: locked
    if (length == 0 || group == 0) break;
    const std::size_t offset_at = at + 2 + length;
    const std::size_t next = word(offset_at);  // checks that the name is in the file
    const std::string name = upper(trimmed(bytes_.substr(at + 2, length)));
    if (group < 0) {
      groups[-group] = name;
    } else {
      std::size_t after = offset_at + 2;
      found.push_back({group, {.group = {}, .name = name, .value = read_values(after)}});
      // Else a small file could repeat the same bytes in thousands of parameters.
      if (next != 0 && offset_at + next < after)
        damaged(fmt::format("the parameter {} overlaps the next one; expected them one after the other", name));
    }
    if (next == 0) break;
    at = offset_at + next;
  }
  for (auto& [group, parameter] : found) {
    const auto known = groups.find(group);
    if (known == groups.end()) continue;
    parameter.group = known->second;
    parameters_.push_back(std::move(parameter));
  }
}

const C3dParameter* C3dFile::find(std::string_view group, std::string_view name) const {
  for (const auto& p : parameters_)
    if (p.group == group && p.name == name) return &p.value;
  return nullptr;
}

const C3dParameter* C3dFile::parameter(std::string_view name) const { return find("POINT", name); }

double C3dFile::first_number(std::string_view group, std::string_view name, double otherwise) const {
  const auto* found = find(group, name);
  return found && !found->numbers.empty() ? found->numbers[0] : otherwise;
}

// 16 bits count 65 535 frames at most: longer recordings say elsewhere how many they are.
double C3dFile::claimed_frames() const {
  const auto field = [&](std::string_view name) {
    const auto* two = find("TRIAL", name);
    return two && two->numbers.size() >= 2 ? two->numbers[0] + 65536 * two->numbers[1] : 0;
  };
  const double first = field("ACTUAL_START_FIELD"), last = field("ACTUAL_END_FIELD");
  if (first > 0 && last >= first) return last - first + 1;
  const double header = static_cast<double>(word(8)) - static_cast<double>(word(6)) + 1;
  return std::max({header, first_number("POINT", "FRAMES", 0), first_number("POINT", "LONG_FRAMES", 0)});
}

void C3dFile::read_layout() {
  points_ = word(2);
  const std::size_t analog = word(4);
  first_ = static_cast<double>(word(6));
  scale_ = first_number("POINT", "SCALE", number(12));
  floating_ = scale_ < 0;
  rate_ = first_number("POINT", "RATE", number(20));
  if (!(rate_ > 0) || !std::isfinite(rate_)) rate_ = 0;
  const std::size_t size = floating_ ? 4 : 2;
  frame_bytes_ = size * (4 * points_ + analog);
  const std::size_t block = word(16);
  if (points_ == 0) damaged("there are no points, only other measurements; expected a recording of positions");
  if (!std::isfinite(scale_) || scale_ == 0) damaged(fmt::format("the scale of positions is {:g}; expected another number", scale_));
  if (block < 2) damaged(fmt::format("the positions begin in block {}; expected one behind the header", block));
  data_ = (block - 1) * kBlock;
  const double frames = claimed_frames();
  const std::size_t held = data_ < bytes_.size() ? (bytes_.size() - data_) / frame_bytes_ : 0;
  if (!(frames >= 1)) damaged(fmt::format("the file has {:g} frames; expected one at least", frames));
  if (frames > static_cast<double>(held))
    damaged(fmt::format("the file is cut short: it holds {} of {:.0f} frames; expected all", held, frames));
  frames_ = static_cast<std::size_t>(frames);
}

C3dFile::C3dFile(const std::string& name, std::string_view bytes) : name_(name), bytes_(bytes) {
  if (!is_c3d(bytes)) damaged("is not a C3D file; expected one");
  const std::size_t start = (byte(0) - 1) * kBlock;
  machine_ = static_cast<Machine>(byte(start + 3));
  read_parameters(start);
  read_layout();
}

std::optional<C3dFile::Point> C3dFile::at(std::size_t frame, std::size_t point) const {
  const std::size_t size = floating_ ? 4 : 2, here = data_ + frame * frame_bytes_ + size * 4 * point;
  // The residual: negative where the point was not seen.
  if (floating_ ? number(here + 12) < 0 : word(here + 6) >= 0x8000) return std::nullopt;
  const auto value = [&](std::size_t axis) { return floating_ ? number(here + 4 * axis) : whole(word(here + 2 * axis)) * scale_; };
  const Point out{value(0), value(1), value(2)};
  return std::isfinite(out.x) && std::isfinite(out.y) && std::isfinite(out.z) ? std::optional(out) : std::nullopt;
}

}  // namespace swarmfit
