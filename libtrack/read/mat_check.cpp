// SPDX-License-Identifier: MIT
#include "libtrack/read/mat_check.h"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

// MATLAB MAT-File Format (The MathWorks), level 5: a header of 128 bytes, then elements of an 8-byte tag (type, size) and their data.
constexpr std::size_t kHeader = 128, kTag = 8;
constexpr std::uint32_t kMatrix = 14, kCompressed = 15;

std::uint32_t word(std::string_view bytes, std::size_t at, bool swap) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return swap ? __builtin_bswap32(value) : value;
}

// Unpacks to nowhere; true when the stream ends properly, which includes its checksum.
bool unpacks(std::string_view packed) {
  z_stream stream{};
  if (packed.size() > std::numeric_limits<uInt>::max() || inflateInit(&stream) != Z_OK) return false;
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));  // zlib reads only, but its interface is older than const
  stream.avail_in = static_cast<uInt>(packed.size());
  std::array<Bytef, 65536> unpacked;
  int state = Z_OK;
  while (state == Z_OK) {
    stream.next_out = unpacked.data();
    stream.avail_out = static_cast<uInt>(unpacked.size());
    state = inflate(&stream, Z_NO_FLUSH);
  }
  inflateEnd(&stream);
  return state == Z_STREAM_END;
}

}  // namespace

void check_mat5(const std::string& name, std::string_view bytes) {
  const auto fail = [&](const std::string& what) -> InputError {
    return InputError(fmt::format("{}: {}; expected an undamaged MATLAB file", name, what));
  };
  if (bytes.size() < kHeader) throw fail("the file is cut off in its header");
  const bool swap = bytes[126] == 'M';  // "MI" was written on a machine of the other byte order; "IM" on one like ours
  std::size_t at = kHeader;
  for (int k = 1; at < bytes.size(); ++k) {
    if (bytes.size() - at < kTag) throw fail("the file is cut off");
    const std::uint32_t type = word(bytes, at, swap), size = word(bytes, at + 4, swap);
    if (type != kMatrix && type != kCompressed) throw fail(fmt::format("element {} at byte {} is of no known type", k, at));
    at += kTag;
    if (bytes.size() - at < size) throw fail("the file is cut off");
    if (type == kCompressed && !unpacks(bytes.substr(at, size))) throw fail(fmt::format("element {} at byte {} does not unpack", k, at));
    at += size;
  }
}

}  // namespace swarmfit
