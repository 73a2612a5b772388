#include "sand/shaped_tool.h"

#include <algorithm>
#include <cmath>

#include "sand/sand_plane.h"
#include "tool/tool_surface.h"

namespace sandstroke {

ShapedTool::ShapedTool(const ToolSettings& settings)
    : Tool(0.0, 0.0),
      surface_(tool_surface(settings)),
      own_rotation_(own_rotation(settings)),
      rotation_(own_rotation_),
      carries_(settings.carries) {
  for (const Eigen::Vector3d& vertex : surface_.vertices) farthest_ = std::max(farthest_, vertex.norm());
  radius_ = reach_ = horizontal_reach(turned(surface_, rotation_));
}

bool ShapedTool::would_turn(const Eigen::Matrix3d& rotation) const {
  if (rotation == rotation_) return false;
  return !envelope_ ||
         (rotation - rotation_).norm() * farthest_ >= envelope_->cell_size() / (8.0 * envelope_->phases());
}

void ShapedTool::turn(const Eigen::Matrix3d& rotation) {
  if (!would_turn(rotation)) return;
  rotation_ = rotation;
  envelope_.reset();
  footprint_.close();
}

void ShapedTool::place(const HeightField& bed, double x, double y) {
  footprint_.set_axis(bed, x, y);
  level_ = std::numeric_limits<double>::quiet_NaN();
  touches_ = false;
  lifted_.clear();
  if (!envelope_ || envelope_->cell_size() != bed.cell_size()) {
    envelope_.emplace(turned(surface_, rotation_), bed.cell_size());
    radius_ = envelope_->inradius();
    reach_ = envelope_->reach();
    if (carries_) {
      if (!upper_ || upper_->grid().cell_size() != bed.cell_size())
        upper_.emplace(turned(surface_, own_rotation_), bed.cell_size());
      upper_->turn(rotation_ * own_rotation_.transpose());
    }
  }
  const double left = envelope_->first_col(), down = envelope_->first_row();
  if (!footprint_.open(bed, {left, left + envelope_->cols() - 2, down, down + envelope_->rows() - 2})) return;
  find_first_sample();
  level_ = fit_sand_plane(bed, footprint_.axis_x() * bed.cell_size(), footprint_.axis_y() * bed.cell_size(),
                          envelope_->reach())
               .height;
}

void ShapedTool::find_first_sample() {
  // For multiples of 2^-30 the distances to a sample and to the next one are both exact.
  const auto split = [&](double cells, int first, int& sample, double& rest) {
    const double position = std::round(envelope_->phases() * cells * 0x1p30) * 0x1p-30;
    const double whole = std::floor(position);
    rest = position - whole;
    sample = std::max(static_cast<int>(whole) - first * envelope_->phases(), 0);
  };
  split(footprint_.first_x() - footprint_.axis_x(), envelope_->first_col(), sample_col_, sample_x_);
  split(footprint_.first_y() - footprint_.axis_y(), envelope_->first_row(), sample_row_, sample_y_);
}

double ShapedTool::covered_height(double tip_height, double touched) const {
  const double depth = level_ - (tip_height + lowest());
  return envelope_->covered_height(std::max(lowest() + (depth > 0.0 ? 2.0 * depth : 0.0), touched));
}

EnvelopeWindow ShapedTool::envelope_window() const {
  EnvelopeWindow window;
  window.stride = envelope_->stride();
  window.lowest = envelope_->lowest();
  const int phases = envelope_->phases();
  for (int corner = 0; corner < 4; ++corner) {
    const int right = corner % 2, up = corner / 2, row = sample_row_ + up, col = sample_col_ + right;
    const std::size_t at = envelope_->at(row / phases, col / phases, row % phases, col % phases);
    window.underside[corner] = envelope_->underside() + at;
    window.cover[corner] = envelope_->cover() + at;
    window.weight[corner] = (right ? sample_x_ : 1.0 - sample_x_) * (up ? sample_y_ : 1.0 - sample_y_);
  }
  return window;
}

WayOutWindow ShapedTool::way_out(double distance) {
  const int phases = envelope_->phases();
  const int row = sample_row_ + (sample_y_ >= 0.5), col = sample_col_ + (sample_x_ >= 0.5);
  const WayOut& way = envelope_->way_out(covered_, distance, row % phases, col % phases);
  const std::size_t at = envelope_->at(row / phases, col / phases, 0, 0);
  return {way.x.data() + at, way.y.data() + at, envelope_->stride()};
}

void ShapedTool::prepare(double distance) {
  if (envelope_) envelope_->make_ways_out(distance);
}

double ShapedTool::carve(double tip_height) {
  lifted_.clear();
  const CarvedUnder carved = carve_under(envelope_window(), footprint_, tip_height);
  touches_ = std::isfinite(carved.highest);
  covered_ = covered_height(tip_height, carved.highest);
  cover_up_to(footprint_, covered_);
  return carved.sum > 0.0 && upper_ ? lift(tip_height) : carved.sum;
}

double ShapedTool::lift(double tip_height) {
  double displaced = 0.0;
  const CellRange& cells = footprint_.cells();
  for (int row = 0; row < cells.rows(); ++row)
    for (int col = 0; col < cells.cols(); ++col) {
      if (!(footprint_.flags(row)[col / cells_per_group] >> (col % cells_per_group) & 1)) continue;
      double& excess = footprint_.excess(row)[col];
      const Eigen::Vector2d from_tip =
          footprint_.cell_size() * Eigen::Vector2d(footprint_.first_x() + col - footprint_.axis_x(),
                                                   footprint_.first_y() + row - footprint_.axis_y());
      const UpperSide::Cell cell = upper_->cell_at(upper_->in_grid(from_tip));
      if (cell.row >= 0) {
        const double lowest = footprint_.heights(row)[col],
                     top = tip_height + upper_->top()(cell.row, cell.col),
                     above = top > lowest ? lowest + excess - top : excess;
        if (above > 0.0) {
          lifted_.push_back({from_tip, above});
          excess -= above;
        }
      }
      displaced += excess;
    }
  return displaced;
}

double ShapedTool::displace_in_footprint(const HeightField& bed, double tip_height,
                                         const Eigen::Vector3d& /*motion*/,
                                         const DisplacementSettings& settings) {
  const double carved = carve(tip_height);
  double lifted = 0.0;
  for (const LiftedSand& one : lifted_) lifted += one.height;
  if (carved == 0.0 || !std::isfinite(carved)) return carved + lifted;
  const double spread = spread_outward(footprint_, carved, {settings.distance, way_out(settings.distance)});
  if (spread <= 0.0) {
    footprint_.read_heights(bed);  // all cells around are tool or wall
    lifted_.clear();
    return 0.0;
  }
  deposit(footprint_, carved / spread, DepositBy::weights);
  return carved + lifted;
}

void ShapedTool::visit_state(StateVisitor& state, const HeightField& bed, const Eigen::Vector3d& tip) {
  bool placed = envelope_.has_value(), touches = touches_;
  double covered = covered_;
  state.value("tool.rotation", rotation_);
  state.value("tool.placed", placed);
  state.value("tool.touches", touches);
  state.value("tool.covered", covered);
  if (!state.restores()) return;
  envelope_.reset();
  footprint_.close();
  if (placed) place(bed, tip.x(), tip.y());
  touches_ = touches;
  covered_ = covered;
}

double ShapedTool::floor_above(double height) const {
  const CellRange& cells = footprint_.cells();
  double sum = 0.0;
  for (int row = 0; row < cells.rows(); ++row)
    for (int col = 0; col < cells.cols(); ++col) sum += std::max(footprint_.floors(row)[col] - height, 0.0);
  return sum / (static_cast<double>(cells.rows()) * cells.cols());
}

void ShapedTool::stand(double tip_height) {
  if (!footprint_.cells().empty())
    covered_ = covered_height(tip_height, -std::numeric_limits<double>::infinity());
}

void ShapedTool::cover() {
  carve_under(envelope_window(), footprint_, std::numeric_limits<double>::infinity());
  cover_up_to(footprint_, covered_);
}

}  // namespace sandstroke
