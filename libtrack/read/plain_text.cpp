// SPDX-License-Identifier: MIT
#include "libtrack/read/plain_text.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "libtrack/error.h"

namespace swarmfit {
namespace {

constexpr std::size_t kMostUnpacked = std::size_t{4} << 30;

// All members of a gzip file, one after the other.
std::string gunzip(const std::string& name, const std::string& packed) {
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) throw RunError(name + ": no memory to unpack");
  struct End {
    z_stream* stream;
    ~End() { inflateEnd(stream); }
  } const end{&stream};
  std::string out;
  std::array<char, 1 << 16> part{};
  std::size_t taken = 0;
  for (int status = Z_OK; status != Z_STREAM_END || stream.avail_in > 0 || taken < packed.size();) {
    if (status == Z_STREAM_END) inflateReset(&stream);
    if (stream.avail_in == 0 && taken < packed.size()) {
      const auto size = std::min<std::size_t>(packed.size() - taken, 1 << 30);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + taken));
      stream.avail_in = static_cast<uInt>(size);
      taken += size;
    }
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    status = inflate(&stream, Z_NO_FLUSH);
    if (status != Z_OK && status != Z_STREAM_END) throw InputError(name + ": the gzip file is broken or cut off; expected a whole one");
    out.append(part.data(), part.size() - stream.avail_out);
    if (out.size() > kMostUnpacked) throw InputError(name + ": unpacks to more than 4 GiB; expected a smaller recording");
  }
  return out;
}

void append_utf8(std::string& out, std::uint32_t c) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((c >> shift) & 0x3F)); };
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | (c >> 6));
    tail(0);
  } else if (c < 0x10000) {
    out += static_cast<char>(0xE0 | (c >> 12));
    tail(6);
    tail(0);
  } else {
    out += static_cast<char>(0xF0 | (c >> 18));
    tail(12);
    tail(6);
    tail(0);
  }
}

// Halves of pairs without the other half become U+FFFD.
std::string utf8_of_utf16(std::string_view bytes, bool big_endian) {
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(big_endian ? a << 8 | b : b << 8 | a);
  };
  std::string out;
  out.reserve(bytes.size() / 2);
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    std::uint32_t c = unit(i);
    if (c >= 0xD800 && c < 0xE000) {
      const bool pair = c < 0xDC00 && i + 3 < bytes.size() && unit(i + 2) >= 0xDC00 && unit(i + 2) < 0xE000;
      c = pair ? 0x10000 + ((c - 0xD800) << 10) + (unit(i + 2) - 0xDC00) : 0xFFFD;
      if (pair) i += 2;
    }
    append_utf8(out, c);
  }
  return out;
}

}  // namespace

std::string plain_bytes(const std::string& name, std::string bytes) {
  if (bytes.starts_with("\x1F\x8B")) bytes = gunzip(name, bytes);
  const std::string_view start = std::string_view(bytes).substr(0, 2);
  if (start == "\xFF\xFE" || start == "\xFE\xFF") bytes = utf8_of_utf16(std::string_view(bytes).substr(2), start == "\xFE\xFF");
  if (std::string_view(bytes).substr(0, 4096).find('\0') != std::string_view::npos) return bytes;
  while (!bytes.empty() && bytes.back() == '\x1A') bytes.pop_back();
  if (bytes.find('\r') != std::string::npos && bytes.find('\n') == std::string::npos) std::replace(bytes.begin(), bytes.end(), '\r', '\n');
  return bytes;
}

}  // namespace swarmfit
