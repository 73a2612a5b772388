#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sand/height_field.h"

namespace sandstroke {

/// Surfaces of one bed, one after the other, to be looked at in 3-D: a part of a page. Where a side has more
/// than most_side cells they are means over more of them. Heights are kept to a thousandth of what a cell
/// then measures.
class SandPart {
 public:
  static constexpr int most_side = 512;      ///< cells, in the page
  static constexpr double most_cells = 2e7;  ///< of a bed: to show more would take too long

  /// Error: input, where the bed has too many cells.
  SandPart(const std::string& title, const std::string& text, const HeightField& bed);
  /// Of the bed's shape; all its heights are finite, or Error: input.
  void add(const std::string& name, const HeightField& surface);
  /// The last surface less the one before may be shown in colours: what that is called.
  void offer_difference(const std::string& name) { part_["difference"] = name; }
  nlohmann::ordered_json json() const { return part_; }

 private:
  int rows_, cols_;
  double quantum_;                                                                      // m
  Eigen::Array<std::int32_t, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> before_;  // in quanta
  nlohmann::ordered_json part_;
};

}  // namespace sandstroke
