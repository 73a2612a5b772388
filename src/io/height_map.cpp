#include "io/height_map.h"

#include <string>

#include "core/error.h"
#include "core/input_file.h"
#include "core/output_file.h"
#include "import/kinds_not_read.h"
#include "io/esri_grid.h"
#include "io/npy_map.h"
#include "io/png_file.h"
#include "io/png_map.h"
#include "io/tiff_map.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

constexpr const char* by_gdal = "convert it: gdal_translate FILE map.tif";
constexpr const char* to_grid =
    "make a grid of its points first: pdal translate FILE map.tif --writers.gdal.resolution=METRES "
    "--writers.gdal.output_type=mean";
constexpr KindNotRead maps_not_read[] = {
    {"PK\x03\x04", ".npz", "a NumPy archive (.npz)",
     "save one array: numpy.save('map.npy', numpy.load('FILE')['NAME'])"},
    {"\xFF\xFE", "", "a text in UTF-16", "save it in UTF-8"},
    {"\xFE\xFF", "", "a text in UTF-16", "save it in UTF-8"},
    {"north:", "", "a GRASS ASCII grid", by_gdal},
    {"DSAA", "", "a Surfer grid", by_gdal},
    {"DSBB", "", "a Surfer grid", by_gdal},
    {"DSRB", "", "a Surfer grid", by_gdal},
    {"CDF\x01", "", "a netCDF file", "convert it: gdal_translate NETCDF:FILE:VARIABLE map.tif"},
    {"CDF\x02", "", "a netCDF file", "convert it: gdal_translate NETCDF:FILE:VARIABLE map.tif"},
    {"\x89HDF\r\n\x1A\n", ".nc", "a netCDF file", "convert it: gdal_translate NETCDF:FILE:VARIABLE map.tif"},
    {"LASF", "", "a point cloud (.las, .laz)", to_grid},
    {"", ".laz", "a point cloud (.laz)", to_grid},
    {"", ".e57", "a point cloud (.e57)", to_grid},
    {"", ".pcd", "a point cloud (.pcd)", to_grid},
    {"", ".xyz", "a list of points (.xyz)", "convert it, if they lie on a grid: gdal_translate FILE map.tif"},
    {"", ".csv", "a table (.csv)",
     "save its heights as an array: numpy.save('map.npy', numpy.loadtxt('FILE', delimiter=','))"},
    {"", ".txt", "a text without the header of an ESRI ASCII grid (ncols, nrows, cellsize)",
     "save its heights as an array: numpy.save('map.npy', numpy.loadtxt('FILE'))"},
    {"", ".dem", "a digital elevation model (.dem)", by_gdal},
    {"", ".hgt", "an SRTM tile (.hgt), whose cells are in degrees",
     "project it to metres: gdalwarp -t_srs EPSG:CODE FILE map.tif"},
    {"", ".flt", "a binary grid (.flt)", by_gdal},
    {"", ".bil", "a binary grid (.bil)", by_gdal},
    {"", ".img", "an ERDAS image (.img)", by_gdal},
    {"", ".vrt", "a virtual raster (.vrt)", by_gdal},
    {"", ".adf", "an ESRI binary grid (.adf)", by_gdal},
    {"", ".grd", "a binary grid (.grd)", by_gdal},
    {"", ".raw", "a file of numbers without a size (.raw, .r16)",
     "save it as an array: numpy.save('map.npy', numpy.fromfile('FILE', '<u2').reshape(ROWS, COLS)[::-1] * "
     "STEP)"},
    {"", ".r16", "a file of numbers without a size (.raw, .r16)",
     "save it as an array: numpy.save('map.npy', numpy.fromfile('FILE', '<u2').reshape(ROWS, COLS)[::-1] * "
     "STEP)"},
    {"\x76\x2F\x31\x01", "", "an OpenEXR picture", "save it as a float TIFF with one channel"},
    {"\xFF\xD8\xFF", "", "a JPEG picture, whose 8 bits are too coarse for heights",
     "save a 16-bit PNG or TIFF"},
    {"BM", ".bmp", "a BMP picture, whose 8 bits are too coarse for heights", "save a 16-bit PNG or TIFF"},
    {"P5", ".pgm", "a PGM picture", "save it as a 16-bit PNG"},
    {"", ".mat", "a MATLAB file", "save the heights as an array: numpy.save('map.npy', ...)"},
    {"", ".stl", "a mesh (.stl)", "make a grid of it first, in a program for meshes"},
    {"", ".obj", "a mesh (.obj)", "make a grid of it first, in a program for meshes"},
    {"", ".ply", "a mesh or point cloud (.ply)", "make a grid of it first, in a program for meshes"},
};

constexpr std::string_view tiff_signatures[] = {
    {"II*\0", 4}, {"MM\0*", 4}, {"II+\0", 4}, {"MM\0+", 4}};  // little and big endian; with 64-bit offsets

bool is_tiff(std::string_view head) {
  for (const std::string_view signature : tiff_signatures)
    if (head.starts_with(signature)) return true;
  return false;
}

}  // namespace

void HeightMap::set_size(const std::string& name, double rows, double cols) {
  if (!(rows >= 1.0 && cols >= 1.0))
    throw_input_error("{}: has {:.0f} x {:.0f} cells; a map has at least one", name, cols, rows);
  if (rows > most_side || cols > most_side || rows * cols > most_cells)
    throw_input_error(
        "{}: has {:.0f} x {:.0f} cells, which are too many; make it coarser, with at most {} per side and "
        "{:.0f} million in all",
        name, cols, rows, most_side, 1e-6 * most_cells);
  layout_.rows = static_cast<int>(rows);
  layout_.cols = static_cast<int>(cols);
}

std::unique_ptr<HeightMap> open_height_map(const fs::path& path) {
  const std::string head = beginning_of(path, 4096);
  refuse_kinds(pointer_kinds, path, head);
  const std::string ending = small_ending(path);
  if (head.starts_with(png_signature) || ending == ".png") return open_png_map(path);
  if (is_tiff(head)) return open_tiff_map(path);
  if (head.starts_with("\x93NUMPY")) return open_npy_map(path);
  if (begins_as_esri_grid(head)) return open_esri_grid(path);
  refuse_kinds(maps_not_read, path, head);
  refuse_kinds(packed_kinds, path, head);
  if (ending == ".asc") return open_esri_grid(path);  // which says what it lacks
  if (ending == ".tif" || ending == ".tiff" || ending == ".npy")
    throw_input_error("{}: is not what its ending {} says; save the map again", path.string(), ending);
  return nullptr;
}

}  // namespace sandstroke
