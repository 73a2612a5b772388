#include "pages/sand_part.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.h"
#include "report/data_uri.h"
#include "sand/cell_means.h"
#include "sand/ground.h"

namespace sandstroke {
namespace {

constexpr double quanta_per_cell = 1000.0;

/// Packs bytes as the page unpacks them: zlib, then base64 (RFC 4648).
std::string packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string small(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(small.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw_io_error("zlib could not compress a surface; there may be too little memory");
  small.resize(size);
  return base64(small);
}

/// Adds a whole number of 32 bits.
void put_whole(std::string& bytes, std::int32_t number) {
  for (const int shift : {0, 8, 16, 24})
    bytes += static_cast<char>(static_cast<std::uint32_t>(number) >> shift & 255u);
}

int shown_side(int cells, int side) {
  const int step = (side + SandPart::most_side - 1) / SandPart::most_side;
  return std::max(1, static_cast<int>(std::lround(static_cast<double>(cells) / step)));
}

}  // namespace

SandPart::SandPart(const std::string& title, const std::string& text, const HeightField& bed)
    : rows_(shown_side(bed.rows(), std::max(bed.rows(), bed.cols()))),
      cols_(shown_side(bed.cols(), std::max(bed.rows(), bed.cols()))) {
  if (static_cast<double>(bed.rows()) * bed.cols() > most_cells)
    throw_input_error("{} x {} cells are too many to show in 3-D on a page", bed.rows(), bed.cols());
  const double cell_size = bed.cell_size() * bed.cols() / cols_;
  const BedGeometry shown(rows_, cols_, cell_size);
  quantum_ = cell_size / quanta_per_cell;
  before_.setZero(rows_, cols_);
  part_ = {{"kind", "sand"},      {"title", title},      {"text", text},
           {"rows", rows_},       {"cols", cols_},       {"cell_size", cell_size},
           {"x0", shown.x_of(0)}, {"y0", shown.y_of(0)}, {"quantum", quantum_},
           {"low", HUGE_VAL},     {"high", -HUGE_VAL},   {"surfaces", nlohmann::ordered_json::array()}};
  if (has_floor(bed)) add_floor(*bed.ground());
}

void SandPart::add_floor(const Ground& ground) {
  constexpr auto none = std::numeric_limits<std::int32_t>::min();
  const CellMeans heights(ground.floor, rows_, cols_);
  std::string bytes;
  for (Eigen::Index row = 0; row < rows_; ++row)
    for (Eigen::Index col = 0; col < cols_; ++col) {
      const double quanta = std::round(heights(row, col) / quantum_);
      put_whole(bytes, std::abs(quanta) < 1e9 ? static_cast<std::int32_t>(quanta) : none);
    }
  part_["floor"] = packed(bytes);
  // The page compares heights in single precision.
  if (std::isfinite(ground.level()))
    part_["bottom"] = std::round(ground.level() / quantum_) * quantum_ + 0.5 * quantum_;
}

void SandPart::add(const std::string& name, const HeightField& surface) {
  const CellMeans heights(surface, rows_, cols_);
  double low = part_["low"], high = part_["high"];
  std::string bytes;
  for (Eigen::Index row = 0; row < rows_; ++row)
    for (Eigen::Index col = 0; col < cols_; ++col) {
      const double height = heights(row, col), quanta = std::round(height / quantum_);
      if (!(std::abs(quanta) < 1e9))
        throw_input_error("{}: height {} m at row {}, column {} cannot be shown in 3-D", name, height, row,
                          col);
      low = std::min(low, height);
      high = std::max(high, height);
      put_whole(bytes, static_cast<std::int32_t>(quanta) - before_(row, col));
      before_(row, col) = static_cast<std::int32_t>(quanta);
    }
  part_["low"] = low;
  part_["high"] = high;
  part_["surfaces"].push_back({{"name", name}, {"data", packed(bytes)}});
}

}  // namespace sandstroke
