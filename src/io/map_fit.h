#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "io/height_map.h"
#include "sand/map_means.h"
#include "sim/scene.h"

namespace sandstroke {

/// How a map lies on a bed.
struct MapFit {
  bool as_it_is;     ///< cell on cell
  std::string text;  ///< "30 x 20 cells of 0.01 m fitted to 48 x 32 cells of 0.00625 m", for the log
};

/// Error: input, unless a map whose lengths are scaled by `scale` is as large as the bed, to half a cell of
/// either. No scale: it fills the bed, whatever lengths its file says.
MapFit fit_on_bed(const MapLayout& map, const BedSettings& bed, std::optional<double> scale,
                  const std::string& name);

/// The means of a map's lines, before they are upright(). take(line) is shown each line, may change it, and
/// returns whether values are missing in it (MapMeans::add).
template <class Take>
MapMeans means_on_bed(HeightMap& map, const BedSettings& bed, MapMeans::Way way, const std::string& name,
                      const Take& take) {
  const bool by_columns = map.layout().by_columns;
  MapMeans means(map.lines(), map.line_length(), by_columns ? bed.cols : bed.rows,
                 by_columns ? bed.rows : bed.cols, way);
  std::vector<double> line(static_cast<std::size_t>(map.line_length()));
  Progress progress("read " + name);
  for (int i = 0; i < map.lines(); ++i) {
    map.next_line(line.data());
    const bool has_gaps = take(line);
    means.add(line, has_gaps);
    progress.update((i + 1.0) / map.lines());
  }
  return means;
}

/// Turns means of lines, in the order of the file, into rows and columns of a bed.
HeightGrid upright(const HeightGrid& lines, const MapLayout& map);

}  // namespace sandstroke
