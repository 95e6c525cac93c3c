// SPDX-License-Identifier: MIT
#include "libtrack/read/unpack.h"

#include <fmt/format.h>
#include <minizip/unzip.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "libtrack/error.h"
#include "libtrack/read/columns.h"

namespace swarmfit {
namespace {

// minizip reads through functions; these make it read bytes in memory.
struct Memory {
  std::string_view bytes;
  std::size_t at = 0;
};

voidpf open_memory(voidpf memory, const void*, int) { return memory; }
uLong read_memory(voidpf, voidpf stream, void* to, uLong size) {
  auto& m = *static_cast<Memory*>(stream);
  const std::size_t n = std::min<std::size_t>(size, m.bytes.size() - m.at);
  std::memcpy(to, m.bytes.data() + m.at, n);
  m.at += n;
  return n;
}
uLong write_memory(voidpf, voidpf, const void*, uLong) { return 0; }
ZPOS64_T tell_memory(voidpf, voidpf stream) { return static_cast<Memory*>(stream)->at; }
long seek_memory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  auto& m = *static_cast<Memory*>(stream);
  const std::size_t from = origin == ZLIB_FILEFUNC_SEEK_CUR ? m.at : origin == ZLIB_FILEFUNC_SEEK_END ? m.bytes.size() : 0;
  if (offset > m.bytes.size() - from) return -1;
  m.at = from + offset;
  return 0;
}
int close_memory(voidpf, voidpf) { return 0; }
int error_memory(voidpf, voidpf) { return 0; }

InputError too_large(const std::string& name, std::size_t packed) {
  return InputError(
      fmt::format("{}: it unpacks to more than {} MiB from {} bytes; expected a recording", name, most_unpacked(packed) >> 20, packed));
}

}  // namespace

std::string gunzip(const std::string& name, std::string_view bytes) {
  const auto damaged = name + ": gzip cannot unpack it; expected an undamaged file";
  z_stream stream{};
  if (bytes.size() > std::numeric_limits<uInt>::max() || inflateInit2(&stream, 15 + 16) != Z_OK) throw InputError(damaged);
  const std::unique_ptr<z_stream, int (*)(z_stream*)> owner(&stream, inflateEnd);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));  // zlib reads only, but its interface is older than const
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string out;
  std::array<char, 65536> buffer;
  for (;;) {
    stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
    stream.avail_out = static_cast<uInt>(buffer.size());
    const int state = inflate(&stream, Z_NO_FLUSH);
    out.append(buffer.data(), buffer.size() - stream.avail_out);
    if (out.size() > most_unpacked(bytes.size())) throw too_large(name, bytes.size());
    if (state == Z_OK) continue;
    if (state != Z_STREAM_END) throw InputError(damaged);
    if (stream.avail_in == 0) return out;
    if (inflateReset(&stream) != Z_OK) throw InputError(damaged);  // gzip files may be strung together
  }
}

// Closes what it has opened, also where ZipFile's constructor throws.
struct ZipFile::Archive {
  Memory memory;
  unzFile file = nullptr;

  Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  ~Archive() {
    if (file) unzClose(file);
  }
};

ZipFile::ZipFile(const std::string& name, std::string_view bytes)
    : name_(name), size_(bytes.size()), archive_(std::make_unique<Archive>()) {
  archive_->memory.bytes = bytes;
  zlib_filefunc64_def functions{open_memory, read_memory,  write_memory, tell_memory,
                                seek_memory, close_memory, error_memory, &archive_->memory};
  archive_->file = unzOpen2_64(nullptr, &functions);
  const auto damaged = InputError(name + ": the zip archive cannot be read; expected an undamaged file");
  if (!archive_->file) throw damaged;
  int state = unzGoToFirstFile(archive_->file);
  for (; state == UNZ_OK; state = unzGoToNextFile(archive_->file)) {
    std::array<char, 1024> member{};
    unz_file_info64 info;
    if (unzGetCurrentFileInfo64(archive_->file, &info, member.data(), member.size() - 1, nullptr, 0, nullptr, 0) != UNZ_OK) throw damaged;
    const std::string_view shown = member.data();
    if (!shown.empty() && shown.back() != '/' && !shown.starts_with("__MACOSX/")) members_.emplace_back(shown);
    if (members_.size() > 10'000) throw InputError(name + ": the zip archive holds more than 10000 files; expected a recording");
  }
  if (state != UNZ_END_OF_LIST_OF_FILE) throw damaged;
}

ZipFile::~ZipFile() = default;

bool ZipFile::has(std::string_view member) const { return std::find(members_.begin(), members_.end(), member) != members_.end(); }

std::string ZipFile::read(const std::string& member) const {
  const auto damaged = InputError(fmt::format("{}: '{}' in the zip archive cannot be unpacked; expected an undamaged file", name_, member));
  unzFile file = archive_->file;
  if (unzLocateFile(file, member.c_str(), 1) != UNZ_OK || unzOpenCurrentFile(file) != UNZ_OK) throw damaged;
  std::string out;
  std::array<char, 65536> buffer;
  int n = 0;
  while ((n = unzReadCurrentFile(file, buffer.data(), static_cast<unsigned>(buffer.size()))) > 0) {
    out.append(buffer.data(), static_cast<std::size_t>(n));
    if (out.size() > most_unpacked(size_)) throw too_large(name_, size_);
  }
  if (unzCloseCurrentFile(file) != UNZ_OK || n < 0) throw damaged;  // closing compares the checksum
  return out;
}

std::string unpacked(const std::string& name, std::string bytes, const std::string& variable, std::vector<std::string>& notes) {
  if (is_gzip(bytes)) {
    bytes = gunzip(name, bytes);
    notes.emplace_back("the file was unpacked (gzip)");
    if (bytes.empty() || is_gzip(bytes)) throw InputError(name + ": there is no recording in it; expected one, packed once");
  }
  if (!is_zip(bytes)) return bytes;
  const ZipFile zip(name, bytes);
  const auto& members = zip.members();
  const bool arrays = std::any_of(members.begin(), members.end(), [](const auto& m) { return m.ends_with(".npy"); });
  if (arrays || zip.has("xl/workbook.xml")) return bytes;
  const auto chosen = variable.empty() && members.size() == 1 ? members[0] : variable;
  if (!zip.has(chosen))
    throw InputError(fmt::format("{}: the zip archive holds {}; expected one recording, or `var` NAME to choose one", name,
                                 members.empty() ? "nothing" : listed(members)));
  notes.push_back(fmt::format("the file was unpacked (zip, '{}')", chosen));
  auto out = zip.read(chosen);
  if (out.empty() || is_gzip(out) || is_zip(out))
    throw InputError(fmt::format("{}: there is no recording in '{}'; expected one, packed once", name, chosen));
  return out;
}

}  // namespace swarmfit
