#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sandstroke {

/// Reads lines of JSON, each an object, as rows of a table. Objects inside have their keys' names joined,
/// "pos.x"; a list of up to 16 numbers has "pos[0]". A null is an empty field, and so are
/// NaN, Infinity and -Infinity, as Python writes them.
class JsonRows {
 public:
  /// The names of the columns, if a line is such an object with at least two fields; else empty.
  static std::vector<std::string> names_in(std::string_view line);

  /// True if a text begins with two lines of such objects. One object alone is rather a tree than a row.
  static bool begin(std::string_view text);

  explicit JsonRows(std::vector<std::string> names);

  /// The fields of a line in the order of the names, empty where the line lacks one; valid until the next
  /// call. Error: input, if it is no such object or has a name that the first line lacks; `location` is the
  /// line's.
  const std::vector<std::string>& split(std::string_view line, const std::string& location);

 private:
  std::vector<std::string> names_, fields_;
  std::unordered_map<std::string, std::size_t> columns_;
};

}  // namespace sandstroke
