// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace swarmfit {

// The bytes of a file as readers want them: unpacked when gzip packed them, UTF-16 with a mark as UTF-8, lines ended by '\n' where '\r'
// alone does it, without DOS's end of file. Other bytes stay as they are. Throws InputError for broken or endless gzip.
std::string plain_bytes(const std::string& name, std::string bytes);

}  // namespace swarmfit
