// Kept simple: it shares no loop with the engine.
#include "reference/relaxation_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/compensated_sum.h"
#include "core/interrupt.h"
#include "sand/talus_law.h"

namespace sandstroke {
namespace {

struct Offset {
  int row, col;
};
// Opposite neighbours side by side: sums go over pairs.
constexpr std::array<Offset, 4> axis_neighbours = {{{0, -1}, {0, 1}, {-1, 0}, {1, 0}}};
constexpr std::array<Offset, 4> diagonal_neighbours = {{{-1, -1}, {1, 1}, {-1, 1}, {1, -1}}};

double paired_sum(const std::array<double, 4>& terms) {
  return (terms[0] + terms[1]) + (terms[2] + terms[3]);
}

class ReferenceRelaxer : public Relaxer {
 public:
  ReferenceRelaxer(const RelaxationSettings& settings, double cell_size)
      : law_(settings, cell_size), max_passes_(settings.max_passes) {}

  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    RelaxationOutcome outcome;
    outcome.tiles_active_max = bed.tile_count();
    heights_ = bed.grid();
    held_.resize(bed.rows(), bed.cols());
    for (int row = 0; row < rows(); ++row)
      for (int col = 0; col < cols(); ++col) held_(row, col) = bed.is_held(row, col);
    CompensatedSum moved;
    const BedNow bed_now = [&]() -> const HeightField& { return write_back(bed), bed; };
    while (true) {
      outcome.cells_visited += heights_.size();
      outcome.residual = 0.0;
      outcome.converged = !look_for_flow(outcome.residual);
      if (outcome.converged || outcome.passes == max_passes_ || interrupted()) break;

      HeightGrid next(heights_.rows(), heights_.cols());
      for (int row = 0; row < rows(); ++row)
        for (int col = 0; col < cols(); ++col)
          next(row, col) = heights_(row, col) + net_inflow(row, col, moved);
      outcome.converged = (next == heights_).all();  // what still flows is below rounding
      if (outcome.converged) break;
      heights_.swap(next);
      ++outcome.passes;
      if (after_pass) after_pass(outcome.passes, bed_now);
    }
    outcome.moved_volume = moved.value() * bed.cell_area();
    write_back(bed);
    return outcome;
  }

 private:
  void write_back(HeightField& bed) const {
    for (int row = 0; row < rows(); ++row)
      for (int col = 0; col < cols(); ++col)
        if (bed(row, col) != heights_(row, col)) bed.set(row, col, heights_(row, col));
  }
  int rows() const { return static_cast<int>(heights_.rows()); }
  int cols() const { return static_cast<int>(heights_.cols()); }

  /// Outside the bed, or held by a solid tool.
  bool is_wall(int row, int col) const {
    return row < 0 || row >= rows() || col < 0 || col >= cols() || held_(row, col);
  }

  /// By how much (row, col) stands above its neighbour; -infinity where either is a wall: nothing flows.
  double drop(int row, int col, Offset to) const {
    const int r = row + to.row, c = col + to.col;
    if (is_wall(row, col) || is_wall(r, c)) return -std::numeric_limits<double>::infinity();
    return heights_(row, col) - heights_(r, c);
  }

  /// What flows in this pass; false where nothing does. Raises `residual` to the steepest cell's, or face's.
  bool look_for_flow(double& residual) {
    if (law_.law == RelaxationLaw::faces) {
      right_ = below_ = HeightGrid::Zero(heights_.rows(), heights_.cols());
      for (int row = 0; row < rows(); ++row)
        for (int col = 0; col < cols(); ++col) {
          right_(row, col) = face_flux(row, col, {0, 1}, residual);
          below_(row, col) = face_flux(row, col, {1, 0}, residual);
        }
      return !((right_ == 0.0).all() && (below_ == 0.0).all());
    }
    factors_ = HeightGrid::Zero(heights_.rows(), heights_.cols());
    for (int row = 0; row < rows(); ++row)
      for (int col = 0; col < cols(); ++col) factors_(row, col) = flow_factor(row, col, residual);
    return !(factors_ == 0.0).all();
  }

  /// From (row, col) to its neighbour, negative the other way.
  double face_flux(int row, int col, Offset to, double& residual) const {
    const double down = drop(row, col, to);
    if (!std::isfinite(down) || down == 0.0) return 0.0;
    const Offset next{row + to.row, col + to.col};
    const double fall = std::abs(down);
    const double behind = down > 0.0 ? drop(row, col, {-to.row, -to.col}) : drop(next.row, next.col, to);
    double along = fall;
    if (behind > 0.0) {
      const double low = std::min(fall, behind), high = std::max(fall, behind);
      along += low * low / (3.0 * high);
    }
    const Offset side{to.col, to.row};
    const double across = 0.5 * (slope_across(row, col, side) + slope_across(next.row, next.col, side));
    const double slope = std::sqrt(along * along + across * across);
    residual = std::max(residual, slope / law_.axis_drop - 1.0);
    return slope > law_.axis_limit ? law_.share * (1.0 - law_.axis_drop / slope) * down : 0.0;
  }

  double slope_across(int row, int col, Offset side) const {
    const bool has_after = !is_wall(row + side.row, col + side.col),
               has_before = !is_wall(row - side.row, col - side.col);
    const double here = heights_(row, col),
                 after = has_after ? heights_(row + side.row, col + side.col) : here,
                 before = has_before ? heights_(row - side.row, col - side.col) : here;
    return (after - before) * (has_after && has_before ? 0.5 : 1.0);
  }

  /// The part of each drop that a cell gives away in this pass; 0 at rest. Raises `residual` to the cell's
  /// own.
  double flow_factor(int row, int col, double& residual) const {
    std::array<double, 4> axis, diagonal;
    for (int i = 0; i < 4; ++i) axis[i] = drop(row, col, axis_neighbours[i]);
    for (int i = 0; i < 4; ++i) diagonal[i] = drop(row, col, diagonal_neighbours[i]);
    return law_.law == RelaxationLaw::paper ? paper_factor(axis, diagonal, residual)
                                            : isotropic_factor(axis, residual);
  }

  double paper_factor(std::array<double, 4> axis, std::array<double, 4> diagonal, double& residual) const {
    const double axis_max = *std::max_element(axis.begin(), axis.end());
    const double diagonal_max = *std::max_element(diagonal.begin(), diagonal.end());
    residual = std::max({residual, axis_max / law_.axis_drop - 1.0, diagonal_max / law_.diagonal_drop - 1.0});
    if (!(axis_max > law_.axis_limit || diagonal_max > law_.diagonal_limit)) return 0.0;
    const double given = law_.share * std::max(axis_max - law_.axis_drop, diagonal_max - law_.diagonal_drop);
    for (double& one : axis) one = one > law_.axis_drop ? one : 0.0;
    for (double& one : diagonal) one = one > law_.diagonal_drop ? one : 0.0;
    return given / (paired_sum(axis) + paired_sum(diagonal));
  }

  double isotropic_factor(const std::array<double, 4>& axis, double& residual) const {
    const double gx = std::max({0.0, axis[0], axis[1]});
    const double gy = std::max({0.0, axis[2], axis[3]});
    const double steepest = std::sqrt(gx * gx + gy * gy);
    residual = std::max(residual, steepest / law_.axis_drop - 1.0);
    if (!(steepest > law_.axis_limit)) return 0.0;
    return law_.share * (1.0 - law_.axis_drop / steepest);
  }

  /// Height that (row, col) gains from its neighbours less what it gives; adds what it gives to `moved`.
  double net_inflow(int row, int col, CompensatedSum& moved) const {
    if (law_.law == RelaxationLaw::faces) {
      const double east = right_(row, col), west = col > 0 ? right_(row, col - 1) : 0.0;
      const double south = below_(row, col), north = row > 0 ? below_(row - 1, col) : 0.0;
      moved.add((std::max(0.0, east) + std::max(0.0, -west)) +
                (std::max(0.0, south) + std::max(0.0, -north)));
      return (west - east) + (north - south);
    }
    const bool paper = law_.law == RelaxationLaw::paper;
    double out = 0.0, in = 0.0;
    const auto exchange = [&](const std::array<Offset, 4>& neighbours, double threshold) {
      std::array<double, 4> given{}, received{};
      for (int i = 0; i < 4; ++i) {
        const double down = drop(row, col, neighbours[i]);
        if (!std::isfinite(down)) continue;
        const int r = row + neighbours[i].row, c = col + neighbours[i].col;
        const double up = heights_(r, c) - heights_(row, col);
        if (down > threshold) given[i] = factors_(row, col) * down;
        if (up > threshold) received[i] = factors_(r, c) * up;
      }
      out += paired_sum(given);
      in += paired_sum(received);
    };
    exchange(axis_neighbours, paper ? law_.axis_drop : 0.0);
    if (paper) exchange(diagonal_neighbours, law_.diagonal_drop);
    moved.add(out);
    return in - out;
  }

  TalusLaw law_;
  std::int64_t max_passes_;
  HeightGrid heights_, factors_;
  HeightGrid right_, below_;  // through the faces to the right of the cells, and below them
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> held_;
};

}  // namespace

std::unique_ptr<Relaxer> make_reference_relaxer(const RelaxationSettings& settings, double cell_size) {
  return std::make_unique<ReferenceRelaxer>(settings, cell_size);
}

}  // namespace sandstroke
