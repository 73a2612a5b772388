#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sand/height_field.h"

namespace sandstroke {

/// A part of a page that shows surfaces of one bed in 3-D, one after the other. Where a side has more than
/// most_side cells, the page has larger cells with mean heights. Heights are rounded to a thousandth of the
/// page's cell size. Where the floor of the bed is bare, it is shown.
class SandPart {
 public:
  static constexpr int most_side = 512;      ///< cells, in the page
  static constexpr double most_cells = 2e7;  ///< of a bed; more would take too long

  /// Error: input, where the bed has too many cells.
  SandPart(const std::string& title, const std::string& text, const HeightField& bed);
  /// Adds a surface of the bed's shape. Error: input, where a height is not finite.
  void add(const std::string& name, const HeightField& surface);
  /// Lets the page colour the last surface by its difference from the one before. name: what that is called.
  void offer_difference(const std::string& name) { part_["difference"] = name; }
  nlohmann::ordered_json json() const { return part_; }

 private:
  void add_floor(const Ground& ground);

  int rows_, cols_;
  double quantum_;                                                                      // m
  Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> before_;  // in quanta
  nlohmann::ordered_json part_;
};

}  // namespace sandstroke
