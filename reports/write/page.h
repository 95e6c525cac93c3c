// SPDX-License-Identifier: MIT
// What every page needs: a template with holes, and a policy that lets nothing run but what was built in.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace swarmfit {

using PageValues = std::map<std::string, std::string, std::less<>>;

// The template with every {{name}} replaced; what is put in is never searched again. Throws std::out_of_range on a name without a value.
std::string filled(std::string_view page, const PageValues& values);

// A section with its heading; nothing without content, which is HTML already.
std::string page_section(std::string_view id, std::string_view title, std::string_view content);

// Content security policy of a page with this style sheet and these scripts, each allowed by its hash, and nothing else.
std::string content_policy(std::string_view style, const std::vector<std::string_view>& scripts);

std::string base64(std::string_view bytes);

// JSON text that cannot end the script element it stands in.
std::string embedded(std::string_view json);

}  // namespace swarmfit
