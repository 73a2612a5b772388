#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace sandstroke {

/// The name of a node without its namespace.
inline std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);  // the whole name, if it has no colon
}

/// The largest XML file [bytes]; as nodes in memory it is several times as large.
inline constexpr std::size_t most_xml_bytes = 50'000'000;

/// Parses XML into the document. Error: input, naming the line; `name` stands for the file.
void parse_xml(std::string_view text, const std::string& name, pugi::xml_document& document);

}  // namespace sandstroke
