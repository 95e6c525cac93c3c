// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <minizip/zip.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "libtrack/error.h"
#include "libtrack/utf8.h"
#include "libtrack/write/own_columns.h"
#include "libtrack/write/write.h"

namespace swarmfit {
namespace {

// minizip writes through functions; these make it write to memory.
struct Memory {
  std::string bytes;
  std::size_t at = 0;
};
voidpf open_memory(voidpf memory, const void*, int) { return memory; }
uLong read_memory(voidpf, voidpf, void*, uLong) { return 0; }
uLong write_memory(voidpf, voidpf stream, const void* from, uLong size) {
  auto& m = *static_cast<Memory*>(stream);
  m.bytes.resize(std::max<std::size_t>(m.bytes.size(), m.at + size));
  std::memcpy(m.bytes.data() + m.at, from, size);
  m.at += size;
  return size;
}
ZPOS64_T tell_memory(voidpf, voidpf stream) { return static_cast<Memory*>(stream)->at; }
long seek_memory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  auto& m = *static_cast<Memory*>(stream);
  m.at = offset + (origin == ZLIB_FILEFUNC_SEEK_CUR ? m.at : origin == ZLIB_FILEFUNC_SEEK_END ? m.bytes.size() : 0);
  return m.at <= m.bytes.size() ? 0 : -1;
}
int close_memory(voidpf, voidpf) { return 0; }
int error_memory(voidpf, voidpf) { return 0; }

void require(bool done) {
  if (!done) throw RunError("the zip archive cannot be made in memory");
}

// Format version 1.0 of numpy.lib.format: the data begin at a multiple of 64 bytes.
std::string npy(const std::string& type, std::size_t count, bool scalar, std::string_view data) {
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, scalar ? "()" : fmt::format("({},)", count));
  header.resize((10 + header.size()) / 64 * 64 + 64 - 10 - 1, ' ');
  header += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size() & 255U);
  out += static_cast<char>(header.size() >> 8U);
  return out.append(header).append(data);
}

template <class T>
std::string numbers(const std::string& type, const std::vector<double>& values, bool scalar = false) {
  std::string data;
  data.reserve(values.size() * sizeof(T));
  for (const double value : values) {
    const T as = static_cast<T>(value);
    data.append(reinterpret_cast<const char*>(&as), sizeof as);
  }
  return npy(type, values.size(), scalar, data);
}

std::string texts(const std::vector<std::string>& values, bool scalar = false) {
  std::vector<std::u32string> wide;
  std::size_t longest = 1;
  for (const auto& text : values) {
    wide.push_back(to_utf32(text));
    longest = std::max(longest, wide.back().size());
  }
  std::string data;
  for (auto& text : wide) {
    text.resize(longest, U'\0');
    data.append(reinterpret_cast<const char*>(text.data()), text.size() * sizeof(char32_t));
  }
  return npy(fmt::format("<U{}", longest), values.size(), scalar, data);
}

class Archive {
 public:
  Archive() {
    zlib_filefunc64_def functions{open_memory, read_memory, write_memory, tell_memory, seek_memory, close_memory, error_memory, &memory_};
    zip_ = zipOpen2_64("swarmfit", APPEND_STATUS_CREATE, nullptr, &functions);
    require(zip_ != nullptr);
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  ~Archive() {
    if (zip_) zipClose(zip_, nullptr);
  }

  void add(const std::string& name, const std::string& bytes) {
    zip_fileinfo info{};
    info.tmz_date = {0, 0, 0, 1, 0, 1980};  // no clock in the file
    require(zipOpenNewFileInZip64(zip_, (name + ".npy").c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, Z_DEFAULT_COMPRESSION,
                                  1) == ZIP_OK);
    for (std::size_t at = 0; at < bytes.size();) {
      const auto part = std::min<std::size_t>(bytes.size() - at, std::numeric_limits<int>::max());
      require(zipWriteInFileInZip(zip_, bytes.data() + at, static_cast<unsigned>(part)) == ZIP_OK);
      at += part;
    }
    require(zipCloseFileInZip(zip_) == ZIP_OK);
  }

  std::string take() {
    require(zipClose(std::exchange(zip_, nullptr), nullptr) == ZIP_OK);
    return std::move(memory_.bytes);
  }

 private:
  Memory memory_;
  zipFile zip_ = nullptr;
};

}  // namespace

std::string to_npz(const Tracks& tracks) {
  const auto& meta = tracks.meta();
  Archive zip;
  zip.add("swarmfit", texts({"tracks/1"}, true));
  zip.add("unit", texts({meta.unit}, true));
  zip.add("dt", numbers<double>("<f8", {meta.dt}, true));
  zip.add("t0", numbers<double>("<f8", {meta.t0}, true));
  zip.add("synthetic", numbers<double>("<f8", {meta.from.synthetic ? 1.0 : 0.0}, true));
  zip.add("names", texts(tracks.names()));
  zip.add("notes", texts(meta.from.notes));
  if (!meta.kinds.empty()) zip.add("kinds", texts(meta.kinds));
  zip.add("episodes", numbers<std::int64_t>("<i8", {tracks.episodes().begin(), tracks.episodes().end()}));
  for (const auto& [name, values] : own_columns(tracks)) {
    const bool whole = name == "track" || name == "frame" || name == "kind";
    zip.add(name, whole ? numbers<std::int64_t>("<i8", values) : numbers<double>("<f8", values));
  }
  return zip.take();
}

}  // namespace swarmfit
