// SPDX-License-Identifier: MIT
#include "reports/write/plain_text.h"

namespace swarmfit {

std::string enumerate(const std::vector<std::string>& items) {
  std::string out;
  for (std::size_t k = 0; k < items.size(); ++k) {
    if (k > 0) out += k + 1 == items.size() ? " and " : ", ";
    out += items[k];
  }
  return out;
}

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto byte = static_cast<unsigned char>(text[k]);
    // C1 controls are U+0080 .. U+009F: in UTF-8 the byte C2 and one of 80 .. 9F.
    const bool c1 = byte == 0xC2 && k + 1 < text.size() && static_cast<unsigned char>(text[k + 1]) < 0xA0;
    if (byte < 0x20 || byte == 0x7F || c1) {
      out += '?';
      if (c1) ++k;
    } else {
      out += text[k];
    }
  }
  return out;
}

}  // namespace swarmfit
