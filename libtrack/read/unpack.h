// SPDX-License-Identifier: MIT
// What is packed by gzip or zip, unpacked in memory.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

// The most that `packed` bytes may unpack to: recordings shrink to a tenth, not to a thousandth.
constexpr std::size_t most_unpacked(std::size_t packed) { return (std::size_t{64} << 20) + 100 * packed; }

inline bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }
inline bool is_zip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

// Throws InputError when the bytes are damaged or unpack to more than most_unpacked().
std::string gunzip(const std::string& name, std::string_view bytes);

class ZipFile {
 public:
  // Throws InputError when the bytes are no sound archive. `bytes` must outlive this.
  ZipFile(const std::string& name, std::string_view bytes);
  ZipFile(const ZipFile&) = delete;
  ZipFile& operator=(const ZipFile&) = delete;
  ~ZipFile();

  const std::vector<std::string>& members() const { return members_; }  // files only, no folders
  bool has(std::string_view member) const;
  std::string read(const std::string& member) const;  // throws InputError, as gunzip does

 private:
  struct Archive;
  std::string name_;
  std::size_t size_;
  std::unique_ptr<Archive> archive_;
  std::vector<std::string> members_;
};

// A recording that is packed, unpacked: gzip, and zip archives that hold one file, or that which --var names. Archives that are formats
// themselves (npz, xlsx) are left as they are. What was done is appended to `notes`. Throws InputError.
std::string unpacked(const std::string& name, std::string bytes, const std::string& variable, std::vector<std::string>& notes);

}  // namespace swarmfit
