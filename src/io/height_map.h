#pragma once

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sandstroke {

/// The description that a file of heights begins with.
struct MapLayout {
  int rows = 0, cols = 0;               ///< cells along y and x
  std::optional<Eigen::Vector2d> cell;  ///< their size along x and y [m]; none: the file does not say it
  bool from_top = true;                 ///< the first row has the largest y
  bool by_columns = false;              ///< lines are columns, the first with the smallest x, instead of rows
  bool gray = false;                    ///< values from 0 (black) to 1 (white); otherwise heights [m]
};

/// The heights of a file, line by line, so that a map of any size takes little memory.
class HeightMap {
 public:
  virtual ~HeightMap() = default;

  /// Largest side, and largest number of cells, of a map that is read.
  static constexpr int most_side = 65536;
  static constexpr double most_cells = 0x1p29;

  const MapLayout& layout() const { return layout_; }
  int lines() const { return layout_.by_columns ? layout_.cols : layout_.rows; }
  int line_length() const { return layout_.by_columns ? layout_.rows : layout_.cols; }

  /// Reads the next of lines() lines, of line_length() values: not-a-number where the map has no data. Error:
  /// input, if the file is cut off or damaged; io.
  virtual void next_line(double* values) = 0;

 protected:
  /// Sets the layout's size. Error: input, naming the file, if it is empty or too large.
  void set_size(const std::string& name, double rows, double cols);

  MapLayout layout_;
};

/// True if a value is the one that stands for no data, to the precision of a float: texts round it.
inline bool is_no_data(double value, double no_data) {
  return value == no_data ||
         (std::isfinite(no_data) && std::abs(value - no_data) <= 2e-7 * std::abs(no_data));
}

/// Opens a PNG, TIFF, NumPy array or ESRI ASCII grid, known by its content or its ending, and reads what it
/// begins with. None: it may be a run file. Error: io; input, naming the way out, for kinds of maps that are
/// not read.
std::unique_ptr<HeightMap> open_height_map(const std::filesystem::path& path);

}  // namespace sandstroke
