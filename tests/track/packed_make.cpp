// SPDX-License-Identifier: MIT
#include "tests/track/packed_make.h"

#include <fmt/format.h>
#include <minizip/zip.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>

#include "libtrack/file.h"

namespace swarmfit {

std::string zipped(const std::vector<Member>& members) {
  const auto path = (std::filesystem::temp_directory_path() / ("swarmfit_zip_test_" + std::to_string(getpid()))).string();
  zipFile zip = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
  const zip_fileinfo info{};
  for (const auto& m : members) {
    zipOpenNewFileInZip64(zip, m.name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, Z_DEFAULT_COMPRESSION, 0);
    zipWriteInFileInZip(zip, m.bytes.data(), static_cast<unsigned>(m.bytes.size()));
    zipCloseFileInZip(zip);
  }
  zipClose(zip, nullptr);
  auto bytes = read_file(path);
  std::filesystem::remove(path);
  return bytes;
}

std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string npy(const std::vector<std::size_t>& dims, const std::string& type, const std::string& data, bool fortran) {
  auto header = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}{}), }}", type, fortran ? "True" : "False",
                            fmt::join(dims, ", "), dims.size() == 1 ? "," : "");
  header.resize((10 + header.size()) / 64 * 64 + 64 - 10 - 1, ' ');
  header += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(header.size() & 255);
  out += static_cast<char>(header.size() >> 8);
  return out + header + data;
}

std::string npy(const std::vector<std::size_t>& dims, const std::vector<double>& values) {
  return npy(dims, "<f8", {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
}

}  // namespace swarmfit
