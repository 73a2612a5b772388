#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sand/height_field.h"

namespace sandstroke {

enum class SurfaceKind { flat, cylinder, cone, cliff, noise, ripples, file };

/// The surface of the sand before anything touches it. The kind decides which fields count.
struct SurfaceSettings {
  SurfaceKind kind = SurfaceKind::flat;
  double radius = 0.2;           ///< m: cylinder, cone (its foot)
  double height = 0.1;           ///< m: cylinder, cone (apex), cliff
  double amplitude = 0.005;      ///< m: noise (uniform in +- amplitude), ripples (half of crest to trough)
  double wavelength = 0.1;       ///< m: ripples; noise (0: every cell on its own)
  std::uint32_t seed = 1;        ///< noise
  std::string file;              ///< a run file (its final surface) or a map (io/height_map.h)
  double low = 0.0, high = 0.0;  ///< m: heights of a picture's black and white, or of a map's lowest and
                                 ///< highest cell; equal: as the file says
  double scale = 1.0;            ///< bed metres per metre of a map
  std::optional<double> nodata;  ///< m: height of a map's cells without data; none: they are refused
};

/// Makes a bed of rows x cols, centred on the origin, with any surface but `file`. A rule gives the heights;
/// no tile is allocated yet. Cells hold averages: exact for cylinder, cliff and ripples, 8 x 8 samples for
/// the cone.
HeightField make_surface(const SurfaceSettings& settings, int rows, int cols, double cell_size,
                         BedShape shape = BedShape::rectangle);

/// Area [m^2] of a disk of this radius at the origin inside the square cell centred at (x, y), both multiples
/// of half a cell.
double disk_cell_area(double radius, double x, double y, double cell_size);

/// Area [m^2] of that disk inside x0 <= x <= x1, y0 <= y <= y1.
double disk_rectangle_area(double radius, double x0, double x1, double y0, double y1);

}  // namespace sandstroke
