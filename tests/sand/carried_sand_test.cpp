#include "sand/carried_sand.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "core/compensated_sum.h"
#include "sand/tool.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using std::numbers::pi;
constexpr double radius = 0.05, thick = 0.004;  // m
const double steepest_at_rest = std::tan(30.0 * pi / 180.0);

RelaxationSettings flow() {
  RelaxationSettings settings;
  settings.law = RelaxationLaw::isotropic;
  settings.method = RelaxationMethod::rkl;
  settings.talus_angle = 30.0;
  return settings;
}
ToolSettings disc() {
  ToolSettings settings;
  settings.shape = ToolShape::cylinder;
  settings.radius = radius;
  settings.height = thick;
  settings.carries = true;
  settings.solid = true;
  return settings;
}
Matrix3d about_y(double degrees) {
  return Eigen::AngleAxisd(degrees * pi / 180.0, Vector3d::UnitY()).toRotationMatrix();
}

/// A tool that is put here and there in a bed, which relaxes each time, with the sand on it. What spills is
/// down at once.
class Carrying {
 public:
  Carrying(const ToolSettings& tool, int side, double cell)
      : bed(side, side, cell), tool_(make_tool(tool)), relaxer_(make_relaxer(flow(), cell)) {
    volume_before_ = bed.volume();
  }
  void put(const Vector3d& tip, const Matrix3d& turn = Matrix3d::Identity()) {
    tool_->turn(turn);
    tool_->place(bed, tip.x(), tip.y());
    if (!sand) sand.emplace(flow(), *tool_->upper_side());
    sand->lie_on(*tool_->upper_side());
    moved_ += tool_->displace(bed, tip.z(), Vector3d::Zero(), {Deposit::outward});
    sand->take(*tool_->upper_side(), tool_->lifted());
    if (tool_->depth(tip.z()) > 0.0)
      tool_->make_walls(bed);
    else
      bed.set_tool_walls({});
    for (int turn_of_both = 0; turn_of_both < 20; ++turn_of_both) {
      moved_ += relaxer_->relax(bed).moved_volume;
      const CarriedSand::Outcome outcome = sand->relax(*tool_->upper_side(), bed, tip);
      spilled += outcome.spilled;
      for (const CarriedSand::Spill& one : outcome.spills)
        bed.set(one.row, one.col, bed(one.row, one.col) + one.volume / bed.cell_area());
      if (outcome.spilled + outcome.ran_on < 1e-15) break;
    }
  }
  /// The sand that bed and tool have more than at the start, over what moved.
  double imbalance() const {
    return std::abs(bed.volume() + sand->volume() - volume_before_) / std::max(moved_, 1e-9);
  }
  const Tool& tool() const { return *tool_; }

  HeightField bed;
  std::optional<CarriedSand> sand;
  double spilled = 0.0;

 private:
  std::unique_ptr<Tool> tool_;
  std::unique_ptr<Relaxer> relaxer_;
  double volume_before_, moved_ = 0.0;
};

/// The volume on a disc that was buried so deep [m], when it has left the sand, tilted so far [deg].
double lifted_volume(int cells, double depth, double tilt) {
  const double cell = radius / cells;
  Carrying disc_in_sand(disc(), 6 * cells, cell);
  const Matrix3d turn = about_y(tilt);
  const double out = radius * std::sin(tilt * pi / 180.0) + thick;
  for (double z = -depth - thick; z < 0.02 + out; z += 0.002) disc_in_sand.put({0.0, 0.0, z}, turn);
  EXPECT_LT(disc_in_sand.imbalance(), 1e-12);
  return disc_in_sand.sand->volume();
}

// Under flat sand of a depth below a tan: a cone less its top.
TEST(CarriedSand, ADiscLiftsAFrustumToFirstOrder) {
  constexpr double depth = 0.01;
  const double exact = pi * depth *
                       (radius * radius - radius * depth / steepest_at_rest +
                        depth * depth / (3.0 * steepest_at_rest * steepest_at_rest));
  EXPECT_NEAR(exact, 5.4474e-5, 1e-9);
  double error_before = 0.0;
  for (const int cells : sanitized ? std::vector{10} : std::vector{10, 20, 40}) {
    const double error = lifted_volume(cells, depth, 0.0) / exact - 1.0;
    EXPECT_LT(error, 0.0) << cells;
    EXPECT_GT(error, -1.5 / cells) << cells;
    if (error_before < 0.0) {
      EXPECT_GT(error, 0.65 * error_before) << cells;
    }
    error_before = error;
  }
}

TEST(CarriedSand, ADeepDiscKeepsTheWholeCone) {
  const double exact = pi * radius * radius * radius * steepest_at_rest / 3.0;
  EXPECT_NEAR(lifted_volume(20, 0.04, 0.0) / exact, 0.93, 0.04);
}

TEST(CarriedSand, KeepsItsBitsAsTheToolGoesAndTurnsAboutTheVertical) {
  Carrying carrying(disc(), 120, 0.0025);
  for (double z = -0.014; z < 0.03; z += 0.002) carrying.put({0.0003, 0.0, z});
  const HeightGrid at_rest = carrying.sand->thickness();
  EXPECT_GT(carrying.sand->volume(), 1e-5);
  for (int step = 1; step < 50; ++step) {
    const double angle = 0.03 * step;
    carrying.put({0.0003 + 0.0007 * step, 0.0005 * step, 0.03 + 0.0003 * step},
                 Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix());
    EXPECT_TRUE((carrying.sand->thickness() == at_rest).all()) << step;
  }
}

TEST(CarriedSand, StaysUpToItsTalusAndLeavesBeyond) {
  Carrying carrying(disc(), 160, 0.0025);
  for (double z = -0.014; z < 0.06; z += 0.002) carrying.put({0.0, 0.0, z});
  double before = carrying.sand->volume();
  for (const double tilt : {5.0, 10.0, 15.0, 20.0, 25.0}) {
    carrying.put({0.0, 0.0, 0.06}, about_y(tilt));
    EXPECT_LT(carrying.sand->volume(), before) << tilt;
    EXPECT_GT(carrying.sand->volume(), 0.0);
    before = carrying.sand->volume();
    // At rest to the bit for as long as it stays so.
    for (int i = 0; i < 30; ++i) carrying.put({0.0, 0.0, 0.06}, about_y(tilt));
    const HeightGrid at_rest = carrying.sand->thickness();
    for (int i = 0; i < 30; ++i) carrying.put({0.0, 0.0, 0.06}, about_y(tilt));
    EXPECT_TRUE((carrying.sand->thickness() == at_rest).all()) << tilt;
    EXPECT_GT(carrying.sand->volume(), 0.98 * before) << tilt;
  }
  carrying.put({0.0, 0.0, 0.06}, about_y(35.0));
  EXPECT_LT(carrying.sand->volume(), 0.01 * before);
  EXPECT_LT(carrying.imbalance(), 1e-12);
}

TEST(CarriedSand, BedAndToolHaveAllSandOverRandomStrokes) {
  const unsigned last = sanitized ? 2 : 12;
  for (unsigned seed = 1; seed <= last; ++seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    ToolSettings tool = disc();
    if (seed % 3 == 1) {
      tool.shape = ToolShape::bowl;
      tool.height = 0.02;
      tool.thickness = 0.008;
    } else if (seed % 3 == 2) {
      tool.shape = ToolShape::shovel;
      tool.size = {0.08, 0.06, 0.02};
      tool.thickness = 0.008;
    }
    Carrying carrying(tool, 90, 0.004);
    Vector3d tip(0.0, 0.0, 0.01);
    double pitch = 0.0, roll = 0.0, yaw = 0.0;
    for (int step = 0; step < 60; ++step) {
      tip += Vector3d(between(-0.008, 0.008), between(-0.008, 0.008), between(-0.006, 0.006));
      tip.z() = std::clamp(tip.z(), -0.04, 0.05);
      pitch = std::clamp(pitch + between(-6.0, 6.0), -50.0, 50.0);
      roll = std::clamp(roll + between(-6.0, 6.0), -50.0, 50.0);
      yaw += between(-10.0, 10.0);
      const Matrix3d turn = Eigen::AngleAxisd(yaw * pi / 180.0, Vector3d::UnitZ()).toRotationMatrix() *
                            about_y(pitch) *
                            Eigen::AngleAxisd(roll * pi / 180.0, Vector3d::UnitX()).toRotationMatrix();
      carrying.put(tip, turn);
      ASSERT_GE(carrying.sand->thickness().minCoeff(), 0.0) << seed << " " << step;
      ASSERT_LT(carrying.imbalance(), 1e-12) << seed << " " << step;
    }
    EXPECT_GT(carrying.spilled, 0.0) << seed;
  }
}

TEST(CarriedSand, RunsOntoAToolThatIsPushedDownIntoTheSand) {
  Carrying carrying(disc(), 160, 0.0025);
  for (double z = 0.002; z > -0.04; z -= 0.001) carrying.put({0.0, 0.0, z});
  EXPECT_GT(carrying.sand->volume(), 0.2 * pi * radius * radius * 0.03);
  EXPECT_LT(carrying.imbalance(), 1e-12);
}

TEST(CarriedSand, OverhangsAreRefusedByName) {
  ToolSettings rake = disc();
  rake.shape = ToolShape::rake;
  rake.radius = 0.01;
  rake.orientation = {90.0, 0.0, 0.0};
  HeightField bed(100, 100, 0.002);
  const std::unique_ptr<Tool> tool = make_tool(rake);
  try {
    tool->place(bed, 0.0, 0.0);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("tool.carries: the tool's upper side is no height field"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace sandstroke
