#include "measure/furrow.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "sim/tool_fit.h"

namespace sandstroke {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t most_stations = 8000;
// Radii. On ground that is worked again, depths jump from furrow to furrow; only many stations give a steady
// median.
constexpr double between_stations = 0.125;

// Radii. A tip at depth D takes at most 2 R D from each section. Relaxed at slope t, that is a V with a heap
// of half its area on each side. The heaps' crests lie sqrt(2 R D / t) (1 + 1/sqrt 2) from the path. This is
// within 6 R down to D = 3.5 R for a talus angle of 30 degrees, and 2.2 R for 20, more than the arm of a tool
// is long.
constexpr double reach = 6.0;

/// A piece of the path, thinned to points half a radius apart. Servo ticks lie so close together that
/// rounding by the encoders would decide direction and length.
class Piece {
 public:
  explicit Piece(const Eigen::Vector2d& first) : points_{first}, lengths_{0.0} {}

  void add(const Eigen::Vector2d& point, double spacing) {
    const double step = (point - points_.back()).norm();
    if (!(step >= spacing)) return;
    points_.push_back(point);
    lengths_.push_back(lengths_.back() + step);
  }
  double length() const { return lengths_.back(); }

  Eigen::Vector2d at(double length) const {
    if (points_.size() == 1 || length <= 0.0) return points_.front();
    const std::size_t next = std::min<std::size_t>(
        std::upper_bound(lengths_.begin(), lengths_.end(), length) - lengths_.begin(), lengths_.size() - 1);
    const double fraction = (length - lengths_[next - 1]) / (lengths_[next] - lengths_[next - 1]);
    return points_[next - 1] + std::min(fraction, 1.0) * (points_[next] - points_[next - 1]);
  }

 private:
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> lengths_;  // m, from the first point
};

std::vector<Piece> thinned(const TipPath& path, double spacing) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < path.pieces.size(); ++i) {
    const std::size_t end = i + 1 < path.pieces.size() ? path.pieces[i + 1] : path.points.size();
    Piece piece(path.points[path.pieces[i]]);
    for (std::size_t k = path.pieces[i] + 1; k < end; ++k) piece.add(path.points[k], spacing);
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

/// Change of height of a cell [m].
class HeightChange {
 public:
  HeightChange(const HeightField& initial, const HeightField& final)
      : initial_(initial), final_(final), same_where_untouched_(same_where_untouched(initial, final)) {}

  const BedGeometry& bed() const { return initial_; }
  double operator()(int row, int col) const {
    const int tile = initial_.tile_index(row / HeightField::tile_side, col / HeightField::tile_side);
    if (same_where_untouched_ && initial_.slot_of(tile) < 0 && final_.slot_of(tile) < 0) return 0.0;
    return final_(row, col) - initial_(row, col);
  }

 private:
  const HeightField& initial_;
  const HeightField& final_;
  bool same_where_untouched_;
};

/// Change of height [m] along a line across the path, sample k at k half cells to the left of it.
class Section {
 public:
  Section(const HeightChange& change, const Eigen::Vector2d& centre, const Eigen::Vector2d& travel)
      : change_(change), centre_(centre), left_(-travel.y(), travel.x()) {}

  double step() const { return 0.5 * change_.bed().cell_size(); }

  /// NaN outside the bed. Between the bed's border and the nearest centres the value is that at the centres.
  double operator()(int k) const {
    const BedGeometry& bed = change_.bed();
    const Eigen::Vector2d position = centre_ + k * step() * left_;
    const double row = bed.row_at(position.y()), col = bed.col_at(position.x());
    if (!(row >= -0.5 && row <= bed.rows() - 0.5 && col >= -0.5 && col <= bed.cols() - 0.5)) return nothing;
    const double r = std::clamp(row, 0.0, bed.rows() - 1.0), c = std::clamp(col, 0.0, bed.cols() - 1.0);
    const int r0 = static_cast<int>(r), c0 = static_cast<int>(c);
    const int r1 = std::min(r0 + 1, bed.rows() - 1), c1 = std::min(c0 + 1, bed.cols() - 1);
    return std::lerp(std::lerp(change_(r0, c0), change_(r0, c1), c - c0),
                     std::lerp(change_(r1, c0), change_(r1, c1), c - c0), r - r0);
  }

 private:
  const HeightChange& change_;
  Eigen::Vector2d centre_, left_;
};

/// One side of the furrow, outwards from the lowest point: where it ends, in samples, and how high the sand
/// beyond it is.
struct Side {
  double edge = nothing, crest = nothing;
};

Side walk(const Section& section, int from, int direction, int far) {
  int k = from;
  double here = section(k), before = here;
  while (here < 0.0) {
    if (std::abs(k + direction) > far) return {};
    before = here;
    here = section(k += direction);
  }
  if (std::isnan(here)) return {};  // outside the bed
  // The edge is where the change is zero, linear in between.
  Side side{.edge = from == k ? k : k - direction * here / (here - before), .crest = 0.0};
  // Untouched sand may come next. The first raised sand after it counts; what follows that is another
  // stroke's.
  for (; std::abs(k) <= far && here >= 0.0 && !(here == 0.0 && side.crest > 0.0);
       here = section(k += direction))
    side.crest = std::max(side.crest, here);
  return side;
}

FurrowMeasures measure(const Section& section, double tool_radius) {
  double least = section(0);
  if (std::isnan(least)) return {};
  const int near = static_cast<int>(tool_radius / section.step()),
            far = static_cast<int>(reach * tool_radius / section.step());
  int lowest = 0;
  for (int k = -near; k <= near; ++k)
    if (const double change = section(k); change < least) {
      least = change;
      lowest = k;
    }
  const Side left = walk(section, lowest, 1, far), right = walk(section, lowest, -1, far);
  return {.depth = std::max(0.0, -least),
          .width = (left.edge - right.edge) * section.step(),
          .rampart = std::fmax(left.crest, right.crest)};
}

/// The median of the values that are numbers; NaN if there is none.
double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return nothing;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

void TipPathGatherer::on_tick(const TickRecord& tick) {
  if (tick.contact) {
    const Eigen::Vector2d tip = tip_of(device_, tick.device_position).head<2>();
    const bool far = path_.points.empty() || (tip - path_.points.back()).norm() >= 0.25 * radius_;
    if (!in_contact_ && far) path_.pieces.push_back(path_.points.size());
    if (far) {
      path_.points.push_back(tip);
      path_.asked.push_back(tip_of(device_, tick.hand.position).z());
    }
  }
  in_contact_ = tick.contact;
}

namespace {

/// NaN if no depth was asked for, or outside the bed.
double asked_depth(const HeightField& initial, const TipPath& path) {
  std::vector<double> depths;
  for (std::size_t i = 0; i < path.asked.size(); ++i)
    depths.push_back(initial.height_at(path.points[i].x(), path.points[i].y()) - path.asked[i]);
  return median(std::move(depths));
}

}  // namespace

std::optional<FurrowMeasures> TipPathGatherer::furrow(const HeightField& initial,
                                                      const HeightField& final) const {
  if (path_.points.empty()) return std::nullopt;
  return measure_furrow(initial, final, path_, radius_);
}

FurrowMeasures measure_furrow(const HeightField& initial, const HeightField& final, const TipPath& path,
                              double tool_radius) {
  if (path.points.empty()) return {};
  const HeightChange change(initial, final);
  const std::vector<Piece> pieces = thinned(path, 0.5 * tool_radius);
  // Stations are spread over the pieces by their length; a contact at a point counts as one radius.
  const auto weight = [&](const Piece& piece) { return std::max(piece.length(), tool_radius); };
  double total = 0.0;
  for (const Piece& piece : pieces) total += weight(piece);
  const auto stations = static_cast<std::size_t>(std::clamp(
      std::round(total / (between_stations * tool_radius)), 1.0, static_cast<double>(most_stations)));

  std::vector<double> depths, widths, ramparts;
  std::size_t station = 0;
  double passed = 0.0;
  for (const Piece& piece : pieces) {
    const auto into_piece = [&] {
      return (static_cast<double>(station) + 0.5) / static_cast<double>(stations) * total - passed;
    };
    for (; station < stations && into_piece() < weight(piece); ++station) {
      const double length = into_piece() / weight(piece) * piece.length();
      // Taken over a radius: on a circle the chord is then exactly parallel to the way at its middle.
      const Eigen::Vector2d travel =
          piece.at(length + 0.5 * tool_radius) - piece.at(length - 0.5 * tool_radius);
      const Section section(change, piece.at(length),
                            travel.isZero(0.0) ? Eigen::Vector2d(1.0, 0.0) : travel.normalized());
      const FurrowMeasures one = measure(section, tool_radius);
      depths.push_back(one.depth);
      widths.push_back(one.width);
      ramparts.push_back(one.rampart);
    }
    passed += weight(piece);
  }
  double length = 0.0;
  for (const Piece& piece : pieces) length += piece.length();
  return {median(std::move(depths)), median(std::move(widths)), median(std::move(ramparts)),
          asked_depth(initial, path), length};
}

std::string furrow_warning(const Scene& scene, const FurrowMeasures& furrow) {
  if (scene.device.model == DeviceModel::dynamic) return "";  // perhaps the hand gave way
  const double reach = tool_reach(scene.tool);
  if (furrow.length < 4.0 * reach || !(furrow.depth < 0.5 * furrow.asked_depth)) return "";
  const std::string left = fmt::format("the furrow is {:.3g} mm deep; the stroke asked for {:.3g} mm",
                                       1e3 * furrow.depth, 1e3 * furrow.asked_depth);
  const bool solid = scene.tool.solid && scene.displacement.deposit == Deposit::outward;
  if (!solid && furrow.asked_depth < 2.0 * reach)
    return left +
           ": in the published model, sand flows into the tool or is pushed into the furrow behind it; set "
           "tool.solid = true and displacement.deposit = \"outward\", as model.preset = \"accurate\" does";
  return fmt::format(
      "{}: behind the tool, sand falls back into such a deep furrow; a larger {} or a steeper "
      "relaxation.talus_angle leaves a deeper one",
      left, width_key(scene.tool));
}

}  // namespace sandstroke
