// SPDX-License-Identifier: MIT
// XML through pugixml; entities are not expanded and nothing outside of the bytes is read.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace pugi {
class xml_document;
class xml_node;
}  // namespace pugi

namespace swarmfit {

// The first element's name, found without parsing all; empty: this is no XML.
std::string_view xml_root(std::string_view bytes);

// Throws InputError with the line when the bytes are no well-formed XML.
std::shared_ptr<const pugi::xml_document> parse_xml(const std::string& name, std::string_view bytes);

// "file:line" of an element.
std::string xml_place(const std::string& name, std::string_view bytes, const pugi::xml_node& node);

// The whole text as a finite number; nothing when it is none.
std::optional<double> xml_number(std::string_view text);

}  // namespace swarmfit
