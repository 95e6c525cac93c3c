// SPDX-License-Identifier: MIT
// Archives and arrays made in memory by the libraries' own writers, for tests of what reads them.
#pragma once

#include <string>
#include <vector>

namespace swarmfit {

struct Member {
  std::string name, bytes;
};

std::string zipped(const std::vector<Member>& members);  // deflated, by minizip
std::string gzipped(const std::string& bytes);           // by zlib

// A .npy of doubles, row-major, as numpy.save writes it; `type` and `data` for others.
std::string npy(const std::vector<std::size_t>& dims, const std::vector<double>& values);
std::string npy(const std::vector<std::size_t>& dims, const std::string& type, const std::string& data, bool fortran = false);

}  // namespace swarmfit
