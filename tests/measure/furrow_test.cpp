#include "measure/furrow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "sim/simulation.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;

constexpr double radius = 0.01;  // m, of the tool
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A V with parabolic ramparts on both sides, by distance from its middle line. Its slope is the same on
/// both sides of its edge.
struct Profile {
  double depth = 0.005, half_width = 0.01, heap = 0.016;  // m; heap: width of a rampart

  double slope() const { return depth / half_width; }
  double rampart() const { return 0.25 * slope() * heap; }
  double operator()(double distance) const {
    if (distance < half_width) return slope() * distance - depth;
    const double u = (distance - half_width) / heap;
    return u < 1.0 ? 4.0 * rampart() * u * (1.0 - u) : 0.0;
  }
  /// The largest error of a measured height. The slope bounds how much the height changes from the cells that
  /// are interpolated, half a cell's diagonal away on average, and to the next sample, a quarter of a cell;
  /// `aside`: how far [m] chords of a curved path lie from it.
  double height_error(double cell, double aside) const {
    return slope() * ((std::numbers::sqrt2 / 2 + 0.25) * cell + aside);
  }
};

using Shape = std::function<double(double x, double y)>;

HeightField bed_of(int rows, int cols, double cell, const Shape& height) {
  HeightField bed(rows, cols, cell);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) bed.set(row, col, height(bed.x_of(col), bed.y_of(row)));
  return bed;
}

const Shape flat = [](double, double) { return 0.0; };
const Shape slanting = [](double x, double y) { return 0.3 * x - 0.1 * y; };
const Shape rippled = [](double x, double) { return 0.004 * std::sin(400.0 * x); };

/// A path of one piece, as ticks at 1 kHz and 0.1 m/s give it.
TipPath path_along(const std::function<Vector2d(double)>& position, double length) {
  TipPath path{{}, {0}};
  for (double s = 0.0; s <= length; s += 1e-4) path.points.push_back(position(s));
  return path;
}

struct Line {
  Vector2d from, direction;
  double length;
  double distance(double x, double y) const {
    const Vector2d to = Vector2d(x, y) - from;
    return std::abs(to.x() * direction.y() - to.y() * direction.x());
  }
  TipPath path() const {
    return path_along([this](double s) -> Vector2d { return from + s * direction; }, length);
  }
};

/// Measures on a bed of 240 x 300 cells of 1 mm.
FurrowMeasures measured(const Shape& initial, const Shape& change, const TipPath& path) {
  const Shape sum = [&](double x, double y) { return initial(x, y) + change(x, y); };
  return measure_furrow(bed_of(240, 300, 1e-3, initial), bed_of(240, 300, 1e-3, sum), path, radius);
}

void expect_profile(const FurrowMeasures& measures, const Profile& profile, double aside = 0.0) {
  const double error = profile.height_error(1e-3, aside);
  EXPECT_NEAR(measures.depth, profile.depth, error);
  EXPECT_NEAR(measures.rampart, profile.rampart(), error);
  EXPECT_NEAR(measures.width, 2.0 * profile.half_width, 2.0 * error / profile.slope());
}

/// The positions where the tip is in contact.
class ContactPath : public SimulationObserver {
 public:
  explicit ContactPath(const Scene& scene) : gatherer_(scene) {}
  void on_tick(const TickRecord& tick) override { gatherer_.on_tick(tick); }
  const TipPath& path() const { return gatherer_.path(); }

 private:
  TipPathGatherer gatherer_;
};

TEST(Furrow, IsExactOnCentresOfCells) {
  // The line lies on a row's centres; edges, crests and the deepest point are on samples.
  const HeightField before(239, 300, 1e-3);
  const Profile profile;
  const HeightField after = bed_of(239, 300, 1e-3, [&](double, double y) { return profile(std::abs(y)); });
  const TipPath path{{{-0.1, 0.0}, {0.0, 0.0}, {0.1, 0.0}}, {0}};
  const FurrowMeasures measures = measure_furrow(before, after, path, radius);
  EXPECT_NEAR(measures.depth, profile.depth, 1e-15);
  EXPECT_NEAR(measures.width, 2.0 * profile.half_width, 1e-14);
  EXPECT_NEAR(measures.rampart, profile.rampart(), 1e-15);
}

TEST(Furrow, HasItsMeasuresInAnyDirectionOnAnyBed) {
  const Profile profile;
  for (const double angle : {0.0, 0.3, std::numbers::pi / 4, 1.2, std::numbers::pi / 2, 2.5})
    for (const Shape& initial : {flat, slanting, rippled}) {
      SCOPED_TRACE(angle);
      const Vector2d direction(std::cos(angle), std::sin(angle));
      const Line line{Vector2d(0.0003, 0.0002) - 0.07 * direction, direction, 0.14};
      expect_profile(
          measured(
              initial, [&](double x, double y) { return profile(line.distance(x, y)); }, line.path()),
          profile);
    }
}

TEST(Furrow, IsExactAlongACircleToo) {
  const Profile profile;
  const double bend = 0.07;
  const TipPath path = path_along(
      [&](double s) -> Vector2d { return bend * Vector2d(std::cos(s / bend), std::sin(s / bend)); },
      2.0 * std::numbers::pi * bend);
  const double chord = 0.5 * radius + 1e-4;
  for (const Shape& initial : {flat, slanting, rippled})
    expect_profile(
        measured(
            initial, [&](double x, double y) { return profile(std::abs(std::hypot(x, y) - bend)); }, path),
        profile, chord * chord / (8.0 * bend));
}

TEST(Furrow, IsTheSameThereAndBackAndWithAHandThatTrembles) {
  const Profile profile;
  const Line line{{-0.08, 0.0002}, {1.0, 0.0}, 0.16};
  const Shape change = [&](double x, double y) { return profile(line.distance(x, y)); };
  const FurrowMeasures there = measured(flat, change, line.path());
  TipPath back = line.path(), trembling = line.path(), resting = line.path();
  std::reverse(back.points.begin(), back.points.end());
  const FurrowMeasures back_again = measured(flat, change, back);
  EXPECT_NEAR(back_again.depth, there.depth, 1e-12);
  EXPECT_NEAR(back_again.width, there.width, 1e-12);
  EXPECT_NEAR(back_again.rampart, there.rampart, 1e-12);
  // The hand trembles by a tenth of a millimetre, more than an encoder's step, and as far as a tick's way.
  for (std::size_t i = 0; i < trembling.points.size(); ++i) trembling.points[i].y() += i % 2 ? 5e-5 : -5e-5;
  expect_profile(measured(flat, change, trembling), profile, 5e-5);
  // A tool that rests before it lifts adds no stations.
  resting.points.insert(resting.points.end(), 100'000, resting.points.back());
  EXPECT_EQ(measured(flat, change, resting).depth, there.depth);
}

TEST(Furrow, CrossingsEndsAndNeighboursDoNotCount) {
  const Profile profile, crossing{0.01, 0.01, 0.01}, neighbour{0.02, 0.02, 0.03};
  const Line line{{-0.08, 0.0002}, {1.0, 0.0}, 0.16};
  const Shape change = [&](double x, double y) {
    if (std::abs(x) < 0.02) return crossing(std::abs(x));
    // Its rampart, higher, begins beyond that of the line, and has its crest within the sections.
    const double beside = neighbour(std::abs(y - 0.08));
    return beside + (x > 0.075 ? 0.0 : profile(line.distance(x, y)));
  };
  expect_profile(measured(flat, change, line.path()), profile);
}

TEST(Furrow, TheMedianIsOverTheLengthOfAllPieces) {
  // 40 radii of one stroke against 30 taps, one radius each, of another depth: the stroke decides.
  const Profile profile, tap{0.002, 0.004, 0.004};
  TipPath path = Line{{-0.12, 0.05}, {1.0, 0.0}, 0.24}.path();
  for (int i = 0; i < 20; ++i) {
    path.pieces.push_back(path.points.size());
    path.points.insert(path.points.end(), 50, Vector2d(-0.12 + 0.012 * i, -0.05));
  }
  expect_profile(measured(
                     flat,
                     [&](double x, double y) {
                       const double nearest = std::remainder(x + 0.12, 0.012);
                       return y > 0.0 ? profile(std::abs(y - 0.05)) : tap(std::hypot(nearest, y + 0.05));
                     },
                     path),
                 profile);
}

TEST(Furrow, TheMedianHardlyDependsOnWhereStationsFall) {
  // 2 to 6 mm deep, to and fro within each radius.
  const auto depth = [](double x) { return 0.004 + 0.004 * std::remainder(x / radius, 1.0); };
  for (const double start : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    const Line line{{-0.1 + start * radius, 0.0002}, {1.0, 0.0}, 0.15};
    const double median = measured(
                              flat,
                              [&](double x, double y) {
                                return Profile{depth(x), 0.01, 0.01}(line.distance(x, y));
                              },
                              line.path())
                              .depth;
    EXPECT_NEAR(median, 0.004, 0.0004) << start;  // an eighth of the range is 0.5 mm
  }
}

TEST(Furrow, APointContactIsASectionThroughIt) {
  const Profile profile;
  const TipPath path{std::vector<Vector2d>(200, Vector2d(0.0204, -0.0301)), {0}};
  for (const Shape& initial : {flat, slanting, rippled})
    expect_profile(
        measured(
            initial, [&](double x, double y) { return profile(std::hypot(x - 0.0204, y + 0.0301)); }, path),
        profile);
}

TEST(Furrow, UntouchedSandBetweenFurrowAndRampartIsPassed) {
  // A sphere less deep than its radius cuts a cap narrower than itself; the ring it fills begins at its
  // radius.
  const Profile profile{0.001, 0.005, 0.016};
  const Line line{{-0.08, 0.0}, {1.0, 0.0}, 0.16};
  const Shape change = [&](double x, double y) {
    const double r = line.distance(x, y);
    return profile(r < 0.005 ? r : r < 0.01 ? 1.0 : r - 0.005);
  };
  expect_profile(measured(flat, change, line.path()), profile);
}

TEST(Furrow, NextToTheBorderHasItsDepthAndOneRampart) {
  const Profile profile;
  const Line line{{-0.1, 0.1142}, {1.0, 0.0}, 0.2};  // 5.8 mm inside
  const FurrowMeasures measures = measured(
      flat, [&](double x, double y) { return profile(line.distance(x, y)); }, line.path());
  EXPECT_NEAR(measures.depth, profile.depth, profile.height_error(1e-3, 0.0));
  EXPECT_NEAR(measures.rampart, profile.rampart(), profile.height_error(1e-3, 0.0));
  EXPECT_TRUE(std::isnan(measures.width));

  // Along most of its way outside: only what is inside counts.
  const Line leaving{{0.1, 0.0}, {1.0, 0.0}, 0.5};
  expect_profile(
      measured(
          flat, [&](double x, double y) { return profile(leaving.distance(x, y)); }, leaving.path()),
      profile);
  const FurrowMeasures outside = measured(flat, flat, Line{{0.2, 0.0}, {1.0, 0.0}, 0.1}.path());
  EXPECT_TRUE(std::isnan(outside.depth) && std::isnan(outside.width) && std::isnan(outside.rampart));
}

TEST(Furrow, IsNothingWithoutContactAndNoFurrowWithoutChange) {
  const FurrowMeasures none = measured(slanting, flat, TipPath{});
  EXPECT_TRUE(std::isnan(none.depth) && std::isnan(none.width) && std::isnan(none.rampart));
  const Line line{{-0.08, 0.0}, {1.0, 0.0}, 0.16};
  const FurrowMeasures unchanged = measured(rippled, flat, line.path());
  EXPECT_EQ(unchanged.depth, 0.0);
  EXPECT_EQ(unchanged.width, 0.0);
  EXPECT_EQ(unchanged.rampart, 0.0);
  // A furrow that was filled beyond the brim is none, and all of it is rampart.
  const FurrowMeasures filled = measured(
      flat, [](double, double y) { return std::max(0.0, 0.004 - std::abs(y)); }, line.path());
  EXPECT_EQ(filled.depth, 0.0);
  EXPECT_EQ(filled.width, 0.0);
  EXPECT_NEAR(filled.rampart, 0.004, 1e-3);
}

TEST(Furrow, LooksOnlyAtTilesOnTheLargestBed) {
  const HeightField before(65536, 65536, 1e-3);
  HeightField after = before;
  const Profile profile;
  const Line line{{30.0, -20.0}, {1.0, 0.0}, 0.1};
  for (int row = 12734; row < 12802; ++row)
    for (int col = 62700; col < 62900; ++col)
      after.set(row, col, profile(line.distance(after.x_of(col), after.y_of(row))));
  expect_profile(measure_furrow(before, after, line.path(), radius), profile);
}

TEST(Furrow, IsAsDeepAsTheTipInAShallowDragInAnyDirection) {
  // The sand that the tool pushes ahead of it stays out of the furrow at 2 mm.
  for (const double angle : {0.0, 0.5, std::numbers::pi / 4}) {
    Scene scene;
    scene.bed.width = scene.bed.depth = 0.3;
    scene.bed.cols = scene.bed.rows = 150;
    scene.displacement.deposit = Deposit::ahead;
    const double x = 0.1 * std::cos(angle), y = 0.1 * std::sin(angle);
    Stroke stroke;
    stroke.gap_threshold = 10.0;
    stroke.time = {0.0, 0.5, 2.5};
    stroke.position = {{-x, -y, 0.01}, {-x, -y, -0.002}, {x, y, -0.002}};
    const HeightField before(150, 150, 0.002);
    Simulation simulation(scene, before, std::move(stroke));
    ContactPath contact(scene);
    simulation.run({&contact});
    const FurrowMeasures measures =
        measure_furrow(before, simulation.bed(), contact.path(), scene.tool.radius);
    EXPECT_NEAR(measures.depth, 0.002, 0.1 * 0.002) << angle;
    EXPECT_GT(measures.rampart, 0.0);
    // The width lies between that of the tool's cap at that depth and that of the sphere.
    EXPECT_GT(measures.width, 2.0 * std::sqrt(2.0 * 0.01 * 0.002 - 0.002 * 0.002) - 0.002) << angle;
    EXPECT_LT(measures.width, 0.02) << angle;
  }
}

TEST(Furrow, ATipThatTremblesAtTheSurfaceIsOnePointOfItsPath) {
  const Scene scene;
  TipPathGatherer gatherer(scene);
  TickRecord tick;
  for (int i = 0; i < 100; ++i) {  // it hovers, then goes 0.1 m, and comes down once more elsewhere
    tick.contact = i % 2 == 0;
    gatherer.on_tick(tick);
  }
  tick.contact = true;
  for (int i = 0; i <= 100; ++i) {
    tick.device_position.x() = 0.001 * i;
    gatherer.on_tick(tick);
  }
  tick.contact = false;
  gatherer.on_tick(tick);
  tick.contact = true;
  tick.device_position.x() = 0.2;
  gatherer.on_tick(tick);
  const TipPath& path = gatherer.path();
  EXPECT_EQ(path.pieces, (std::vector<std::size_t>{0, path.points.size() - 1}));
  EXPECT_EQ(path.points.size(), 1u + 33u + 1u);  // every 3 mm: the first millimetre beyond a quarter radius
}

TEST(Furrow, TellsHowDeepTheTipWasAskedToBeBelowTheSandAsItWas) {
  // Along a line on a slope, 3 mm below the sand but for its ends.
  const HeightField bed = bed_of(240, 300, 1e-3, [](double x, double) { return 0.1 * x; });
  TipPath path;
  path.pieces = {0};
  for (int i = 0; i <= 20; ++i) {
    const double x = -0.05 + 0.005 * i;
    path.points.emplace_back(x, 0.0);
    path.asked.push_back(0.1 * x - (i < 3 ? 0.0 : 0.003));
  }
  EXPECT_NEAR(measure_furrow(bed, bed, path, 0.01).asked_depth, 0.003, 0.1 * 0.5e-3 + 1e-12);
  path.asked.clear();
  EXPECT_TRUE(std::isnan(measure_furrow(bed, bed, path, 0.01).asked_depth));
}

TEST(Furrow, WarnsOfADragThatLeavesLessThanHalfAndSaysWhatHelps) {
  Scene paper, accurate;
  accurate.preset = ModelPreset::accurate;
  apply_model_preset(accurate);
  const FurrowMeasures less{.depth = 0.0019, .asked_depth = 0.004, .length = 0.04},
      half{.depth = 0.002, .asked_depth = 0.004, .length = 0.04},
      hole{.depth = 0.0019, .asked_depth = 0.004, .length = 0.039};
  EXPECT_NE(furrow_warning(paper, less).find("model.preset = \"accurate\""), std::string::npos);
  EXPECT_NE(furrow_warning(paper, less).find("1.9 mm deep; the stroke asked for 4 mm"), std::string::npos);
  EXPECT_NE(furrow_warning(accurate, less).find("tool.radius"), std::string::npos);
  Scene plate = accurate;
  plate.tool.shape = ToolShape::plate;
  const FurrowMeasures of_plate{.depth = 0.0019, .asked_depth = 0.004, .length = 1.0};
  EXPECT_NE(furrow_warning(plate, of_plate).find("a larger tool.thickness or"), std::string::npos);
  Scene dynamic = paper;
  dynamic.device.model = DeviceModel::dynamic;
  EXPECT_EQ(furrow_warning(dynamic, less), "");
  EXPECT_EQ(furrow_warning(paper, half), "");
  EXPECT_EQ(furrow_warning(paper, hole), "");
  EXPECT_EQ(furrow_warning(paper, FurrowMeasures{}), "");
}

TEST(Furrow, TellsTheWayInContact) {
  TipPath path;
  path.points = {{0.0, 0.0}, {0.02, 0.0}, {0.041, 0.0}, {0.1, 0.0}, {0.1, 0.03}};
  path.pieces = {0, 3};  // lifted in between
  EXPECT_NEAR(measured(flat, flat, path).length, 0.071, 1e-12);
}

TEST(Furrow, TheMedianOfAnEvenNumberIsTheMeanOfBothInTheMiddle) {
  const HeightField bed(240, 300, 1e-3);
  TipPath path;
  path.pieces = {0};
  for (const double asked : {-0.001, -0.008, -0.002, -0.004}) {
    path.points.emplace_back(0.01 * static_cast<double>(path.points.size()), 0.0);
    path.asked.push_back(asked);
  }
  EXPECT_NEAR(measure_furrow(bed, bed, path, 0.01).asked_depth, 0.003, 1e-15);
}

TEST(Furrow, SectionsReachSixRadiiToEitherSide) {
  // A furrow as wide as 11 radii is measured, one of 13 has no width.
  for (const auto& [radii, measured_width] : {std::pair{5.5, true}, {6.5, false}}) {
    const Profile profile{0.005, radii * radius, 0.02};
    const Line line{{-0.1, 0.0}, {1.0, 0.0}, 0.2};
    const Shape change = [&, &p = profile](double x, double y) { return p(line.distance(x, y)); };
    EXPECT_EQ(std::isnan(measured(flat, change, line.path()).width), !measured_width) << radii;
  }
}

TEST(Furrow, AWarningBeginsWhereItSays) {
  const Scene scene;  // a radius of 10 mm
  const auto warning = [&](double fraction_left, double asked, double radii) {
    return furrow_warning(scene,
                          {.depth = fraction_left * asked, .asked_depth = asked, .length = 0.01 * radii});
  };
  EXPECT_NE(warning(0.475, 0.004, 4.2), "");
  EXPECT_EQ(warning(0.525, 0.004, 4.2), "");
  EXPECT_EQ(warning(0.475, 0.004, 3.8), "");
  EXPECT_NE(warning(0.1, 0.019, 10.0).find("model.preset"), std::string::npos);
  EXPECT_NE(warning(0.1, 0.021, 10.0).find("tool.radius"), std::string::npos);
}

TEST(Furrow, SectionsEndAtTheBordersOfABedThatIsNotSquare) {
  // Along x at the far end of a long bed, and along y at that of a deep one.
  const Profile profile{0.004, 0.008, 0.012};
  for (const bool along_x : {true, false}) {
    const int rows = along_x ? 100 : 400, cols = along_x ? 400 : 100;
    const Line line{along_x ? Vector2d(0.1, 0.0) : Vector2d(0.0, 0.1),
                    along_x ? Vector2d(1.0, 0.0) : Vector2d(0.0, 1.0), 0.08};
    const Shape change = [&](double x, double y) { return profile(line.distance(x, y)); };
    expect_profile(
        measure_furrow(bed_of(rows, cols, 1e-3, flat), bed_of(rows, cols, 1e-3, change), line.path(), radius),
        profile);
  }
}

}  // namespace
}  // namespace sandstroke
