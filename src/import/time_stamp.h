#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sandstroke {

/// Reads ISO 8601 ("2024-05-01T12:00:00.123456789+02:00", also with a blank for the T, or without an offset),
/// or a time of day ("12:00:00.5"), as ns since 1970 or midnight.
std::optional<std::int64_t> iso_time(std::string_view text);

/// Reads the column of times. A clock's stamps (ISO 8601, or more than 9 digits before the point) are taken
/// relative to the first before they become doubles: a double has 15 digits, a stamp of today in ns has 19.
class TimeStamps {
 public:
  /// None: the text is no stamp, or not of the kind of the first.
  std::optional<double> read(std::string_view text);

  /// The stamp that was subtracted, in the column's unit; none: these are no clock's stamps.
  std::optional<std::int64_t> origin() const {
    return kind_ == Kind::clock || kind_ == Kind::iso ? std::optional(origin_) : std::nullopt;
  }
  bool iso() const { return kind_ == Kind::iso; }  ///< the unit is ns

 private:
  enum class Kind { none, plain, clock, iso } kind_ = Kind::none;
  std::int64_t origin_ = 0;
};

}  // namespace sandstroke
