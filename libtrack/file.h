// SPDX-License-Identifier: MIT
// Whole files in and out.
#pragma once

#include <string>
#include <string_view>

namespace swarmfit {

// All bytes of a file. Throws InputError when there is no such file or it is a directory, RunError when reading fails.
std::string read_file(const std::string& path);

// Writes under a temporary name in the same folder, flushes to the disk and renames, so that `path` holds either its old content or
// all of the new one, whatever happens in between. Devices and pipes are written directly. Throws RunError.
void write_file_atomically(const std::string& path, std::string_view bytes);

// A file that grows at its end, opened or created. Every append is on the disk before it returns, so it survives the death of the process,
// and a power cut. All members throw RunError.
class AppendedFile {
 public:
  explicit AppendedFile(const std::string& path);
  AppendedFile(const AppendedFile&) = delete;
  AppendedFile& operator=(const AppendedFile&) = delete;
  ~AppendedFile();
  void append(std::string_view bytes);
  void truncate(std::size_t size);  // keeps the first `size` bytes

 private:
  std::string path_;
  int descriptor_;
};

// Creates a directory and those above it, if they are not there, and puts their names on the disk. Throws RunError.
void make_directory(const std::string& path);

// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

}  // namespace swarmfit
