#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>

#include "core/error.h"
#include "core/output_file.h"
#include "haptics/stroke_placement.h"
#include "import/import_stroke.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double half = 0.70710678118654752;

ImportedStroke with_position(const std::string& position, const std::string& text) {
  TableSettings settings;
  settings.rate = 10.0;
  settings.position = position;
  settings.force_sign = ForceSign::by_hand;
  return import_stroke_text(text, "in.csv", settings);
}

TEST(TableAxes, AreNegatedAndPermuted) {
  const std::string text = "x_m,y_m,z_m,vx_mps,vy_mps,vz_mps,fx_N,fy_N,fz_N\n1,2,3,4,5,6,7,8,9\n";
  const ImportedStroke turned = with_position("-x_m,z_m,y_m", text);
  EXPECT_EQ(turned.stroke.position[0], Vector3d(-1, 3, 2));
  EXPECT_EQ(turned.stroke.velocity[0], Vector3d(-4, 6, 5));  // along with it
  EXPECT_EQ(turned.stroke.force[0], Vector3d(-7, 9, 8));
  EXPECT_THAT(turned.warnings, ElementsAre());
  EXPECT_EQ(with_position("x,y,z", text).stroke.position[0], Vector3d(1, 2, 3));  // without the unit
  EXPECT_EQ(with_position("x,-y", text).stroke.force[0], Vector3d(7, -8, 9));
  EXPECT_EQ(with_position("x,z", text).stroke.force[0], Vector3d(7, 9, 8));  // y is left: it is up
  EXPECT_THROW(with_position("x,x,z", text), Error);
  EXPECT_THROW(with_position("x", text), Error);
}

TEST(TablePressure, IsFoundByItsNameOrNamed) {
  const ImportedStroke found = with_position("x,y", "x_mm,y_mm,Pressure\n1,2,300\n3,4,-0.5\n");
  EXPECT_THAT(found.stroke.pressure, ElementsAre(300.0, -0.5));
  EXPECT_THAT(found.description, HasSubstr("pressure Pressure"));
  TableSettings settings;
  settings.rate = 10.0;
  settings.pressure = "p";
  EXPECT_THAT(import_stroke_text("x_mm,y_mm,p,pressure\n1,2,7,8\n", "in.csv", settings).stroke.pressure,
              ElementsAre(7.0));
  for (const char* other : {"air pressure target", "p", "pressures"})
    EXPECT_THAT(with_position("x,y", std::string("x_mm,y_mm,") + other + "\n1,2,3\n").stroke.pressure,
                ElementsAre())
        << other;
}

TEST(TablePressure, APenWithoutPressureIsUp) {
  const std::string text = "x_mm,y_mm,pressure\n1,2,0\n3,4,0.5\n5,6,0.7\n7,8,0\n";
  const ImportedStroke hovering = with_position("x,y", text);
  EXPECT_THAT(hovering.stroke.contact, ElementsAre(pen_up, pen_down, pen_down, pen_up));
  EXPECT_THAT(hovering.description, HasSubstr("up in 2 samples without pressure"));
  for (const char* same : {"x_mm,y_mm,pressure\n1,2,0\n3,4,0\n", "x_mm,y_mm,pressure\n1,2,3\n3,4,5\n"})
    EXPECT_THAT(with_position("x,y", same).stroke.contact, ElementsAre()) << "it says nothing of the pen";
}

TEST(TableAxes, PixelsCountDownwards) {
  TableSettings settings;
  settings.rate = 10.0;
  settings.pixel_size = 1e-3;
  settings.position_unit = "px";
  const std::string text = "x,y\n1,2\n3,4\n";
  EXPECT_THAT(import_stroke_text(text, "in.csv", settings).warnings,
              ElementsAre(HasSubstr("--position) to \"x,-y\"")));
  EXPECT_THAT(with_position("", "x_mm,y_mm,pressure\n1,2,5\n").warnings, ElementsAre(HasSubstr("x_mm,-y_mm")))
      << "of a tablet";
  EXPECT_THAT(import_stroke_text("x,y\n1,-2\n3,-4\n", "in.csv", settings).warnings, ElementsAre())
      << "below the origin: somebody turned it over";
  settings.position = "x,-y";
  EXPECT_THAT(import_stroke_text(text, "in.csv", settings).warnings, ElementsAre());
}

TEST(TableColumns, WhatIsNotUsedIsSaid) {
  const ImportedStroke imported = with_position("x,y", "x_mm,y_mm,fx,fy,gripper,mode\n1,2,3,4,5,6\n");
  EXPECT_THAT(imported.description, HasSubstr("not used: gripper, mode"));
  EXPECT_THAT(imported.warnings, ElementsAre(HasSubstr("fx, fy left out, because its unit is not known")));
  EXPECT_THAT(imported.stroke.force, ElementsAre());
}

TEST(TableAxes, LeftHandedOnesAreSaid) {
  const std::string named = "x_m,y_m,z_m\n1,2,3\n", numbered = "a,b,c\n1,2,3\n";
  for (const char* position : {"x,y,-z", "y,x,z", "-x,-y,-z", "x,z,y"})
    EXPECT_THAT(with_position(position, named).warnings, ElementsAre(HasSubstr("left-handed"))) << position;
  for (const char* position : {"x,y,z", "y,z,x", "-x,-y,z", "y,-x,z", "x,-z,y"})
    EXPECT_THAT(with_position(position, named).warnings, ElementsAre()) << position;
  TableSettings settings;
  settings.rate = 1.0;
  settings.position_unit = "m";
  settings.position = "a,c,b";  // by their order in the table
  EXPECT_THAT(import_stroke_text(numbered, "in.csv", settings).warnings,
              ElementsAre(HasSubstr("left-handed")));
}

TEST(TableAxes, WhoseForceItIsIsAskedForOnce) {
  TableSettings settings;
  settings.rate = 1.0;
  const std::string text = "x_m,y_m,fx_N,fy_N,fz_N\n1,2,3,4,5\n";
  const ImportedStroke unsaid = import_stroke_text(text, "in.csv", settings);
  EXPECT_THAT(unsaid.warnings,
              ElementsAre(HasSubstr("stroke.table.force_sign (stroke convert: --force-sign)")));
  EXPECT_EQ(unsaid.stroke.force_sign, ForceSign::not_said);
  settings.force_sign = ForceSign::by_hand;
  const ImportedStroke said = import_stroke_text(text, "in.csv", settings);
  EXPECT_THAT(said.warnings, ElementsAre());
  EXPECT_EQ(said.stroke.force_sign, ForceSign::by_hand);
  EXPECT_EQ(said.stroke.force[0], Vector3d(3, 4, 5));  // as recorded
}

TEST(TableAxes, OrientationsAreKeptAndTurned) {
  // About z by 90 deg, as a quaternion and as a matrix.
  const std::string quaternion = "x_m,y_m,z_m,qx,qy,qz,qw\n0,0,0,0,0,0.70710678,0.70710678\n";
  const std::string matrix = "x_m,y_m,z_m,r11,r12,r13,r21,r22,r23,r31,r32,r33\n0,0,0,0,-1,0,1,0,0,0,0,1\n";
  for (const std::string& text : {quaternion, matrix}) {
    const Stroke stroke = with_position("x,y,z", text).stroke;
    ASSERT_EQ(stroke.orientation.size(), 1u);
    EXPECT_TRUE((Quaterniond(stroke.orientation[0]) * Vector3d(1, 0, 0)).isApprox(Vector3d(0, 1, 0), 1e-9));
    // The tool's own x axis points along the table's y, which is the stroke's z.
    const Stroke turned = with_position("x,-z,y", text).stroke;
    EXPECT_TRUE((Quaterniond(turned.orientation[0]) * Vector3d(1, 0, 0)).isApprox(Vector3d(0, 0, 1), 1e-9));
    StrokePlacement placement;
    placement.rotate_z = 90.0;
    const Stroke placed = place_stroke(stroke, placement);
    EXPECT_TRUE((Quaterniond(placed.orientation[0]) * Vector3d(1, 0, 0)).isApprox(Vector3d(-1, 0, 0), 1e-9));
  }
  EXPECT_THROW(with_position("x,y,z", "x_m,y_m,z_m,qx,qy,qz,qw\n0,0,0,0,0,0,0\n"), Error);
  EXPECT_THROW(
      with_position("x,y,z", "x_m,y_m,z_m,r11,r12,r13,r21,r22,r23,r31,r32,r33\n0,0,0,1,0,0,0,1,0,0,0,-1\n"),
      Error);
}

/// A plate leads along its own x, and is wide along its own y. Its mirror image does the same.
TEST(TableAxes, OrientationsAreMirroredWithThem) {
  const Eigen::Matrix3d turn =
      (Eigen::AngleAxisd(0.7, Vector3d::UnitZ()) * Eigen::AngleAxisd(-0.4, Vector3d::UnitY()) *
       Eigen::AngleAxisd(0.3, Vector3d::UnitX()))
          .toRotationMatrix();
  const Quaterniond q(turn);
  const std::string text =
      fmt::format("x_m,y_m,z_m,qx,qy,qz,qw\n1,2,3,{},{},{},{}\n", q.x(), q.y(), q.z(), q.w());
  const std::string tail = "left-handed, so orientation qx, qy, qz, qw is mirrored, too";
  struct Mirrored {
    const char* position;
    Eigen::Matrix3d axes;
  };
  Eigen::Matrix3d z_down, swapped, y_down;
  z_down << 1, 0, 0, 0, 1, 0, 0, 0, -1;
  swapped << 0, 1, 0, 1, 0, 0, 0, 0, 1;
  y_down << 1, 0, 0, 0, -1, 0, 0, 0, 1;
  for (const auto& [position, axes] :
       {Mirrored{"x,y,-z", z_down}, Mirrored{"y,x,z", swapped}, Mirrored{"x,-y", y_down}}) {
    const ImportedStroke made = with_position(position, text);
    ASSERT_EQ(made.stroke.orientation.size(), 1u) << position;
    const Eigen::Matrix3d tool = Quaterniond(made.stroke.orientation[0]).toRotationMatrix();
    const Eigen::Matrix3d image = axes * turn;  // of the tool's axes
    EXPECT_TRUE(tool.col(0).isApprox(image.col(0), 1e-9)) << position;
    EXPECT_TRUE(tool.col(1).isApprox(-image.col(1), 1e-9)) << position;  // the other side
    EXPECT_TRUE(tool.col(2).isApprox(image.col(2), 1e-9)) << position;
    EXPECT_THAT(made.warnings, testing::Contains(HasSubstr(tail))) << position;
  }
}

TEST(TableColumns, ThatAreFoundCanBeSwitchedOff) {
  const std::string text =
      "x_m,y_m,z_m,vx_mps,vy_mps,vz_mps,fx_N,fy_N,fz_N,qx,qy,qz,qw,pressure\n1,2,3,4,5,6,7,8,9,0,0,0,1,5\n";
  TableSettings settings;
  settings.rate = 1.0;
  EXPECT_FALSE(import_stroke_text(text, "in.csv", settings).stroke.force.empty());
  settings.velocity = settings.force = settings.orientation = settings.pressure = "none";
  const ImportedStroke made = import_stroke_text(text, "in.csv", settings);
  EXPECT_TRUE(made.stroke.velocity.empty() && made.stroke.force.empty() && made.stroke.orientation.empty() &&
              made.stroke.pressure.empty());
  EXPECT_THAT(made.warnings, ElementsAre());
  EXPECT_THAT(made.description, HasSubstr("not used: vx_mps, vy_mps"));
}

class MergedTables : public testing::Test {
 protected:
  ImportedStroke merged(const std::string& first, const std::string& second, double shift = 0.0,
                        const std::string& position = "") {
    for (const char* name : {"first.csv", "second.csv"}) std::filesystem::remove(folder_ / name);
    write_text_file(folder_ / "first.csv", first);
    write_text_file(folder_ / "second.csv", second);
    TableSettings settings;
    settings.merge = "second.csv";
    settings.position = position;
    settings.merge_shift = shift;
    settings.force_sign = ForceSign::on_device;
    return import_stroke(folder_ / "first.csv", settings);
  }
  std::string refusal(const std::string& first, const std::string& second) {
    try {
      merged(first, second);
    } catch (const Error& failure) {
      return failure.what();
    }
    return "";
  }
  TestFolder folder_;
};

TEST_F(MergedTables, ForcesAreInterpolatedAtTheFirstOnesTimes) {
  const Stroke stroke =
      merged("t_s,x_m,y_m\n0,0,0\n1,1,0\n2,2,0\n", "t_ms;fx_N;fy_N;fz_N\n0;0;0;0\n800;8;0;-8\n4000;8;16;0\n")
          .stroke;
  ASSERT_EQ(stroke.size(), 3u);
  EXPECT_TRUE(stroke.force[1].isApprox(Vector3d(8, 1, -7.5), 1e-12));
  EXPECT_TRUE(stroke.force[2].isApprox(Vector3d(8, 6, -5), 1e-12));
  EXPECT_EQ(stroke.force_sign, ForceSign::on_device);
}

/// A pen in the second table says nothing of the first one's samples.
TEST_F(MergedTables, OtherColumnsOfTheSecondLeaveNothingOut) {
  const std::string first = "t_s,x_m,y_m\n0,0,0\n1,1,0\n2,2,0\n3,3,0\n";
  const std::vector<Vector3d> plain =
      merged(first, "t_s,fx_N,fy_N\n0,0,0\n1,2,0\n2,4,0\n3,6,0\n").stroke.force;
  ASSERT_EQ(plain.size(), 4u);
  for (const std::string second :
       {"t_s,fx_N,fy_N,pressure\n0,0,0,1\n1,2,0,\n2,4,0,0\n3,6,0,1\n",
        "t_s,fx_N,fy_N,pen_down\n0,0,0,1\n1,2,0,0\n2,4,0,0\n3,6,0,1\n",
        "t_s,fx_N,fy_N,stroke_id\n0,0,0,1\n1,2,0,1\n2,4,0,2\n3,6,0,2\n",
        "t_s,fx_N,fy_N,vx_mps,vy_mps\n0,0,0,1,1\n1,2,0,,\n2,4,0,1,1\n3,6,0,1,1\n"}) {
    const ImportedStroke made = merged(first, second);
    EXPECT_EQ(made.stroke.force, plain) << second;
    EXPECT_TRUE(made.stroke.joined(1)) << second;
    EXPECT_THAT(made.warnings, ElementsAre()) << second;
  }
}

TEST_F(MergedTables, TheSecondOnesTimesHaveTheirOwnKeys) {
  EXPECT_THAT(refusal("t_s,x_m,y_m\n0,0,0\n1,1,0\n", "t,fx_N,fy_N,fz_N\n0,1,2,3\n1,4,5,6\n"),
              HasSubstr("give stroke.table.merge_time_unit"));
  EXPECT_THAT(refusal("t_s,x_m,y_m\n0,0,0\n1,1,0\n", "a,fx_N,fy_N,fz_N\n0,1,2,3\n1,4,5,6\n"),
              HasSubstr("stroke.table.merge_rate"));
}

/// Two tables are one table in two files.
TEST_F(MergedTables, TurnWithThePositionsColumns) {
  const std::string turned = "-y,x,z";
  const Stroke two =
      merged("t_s,x_m,y_m,z_m\n0,1,2,3\n1,4,5,6\n",
             "t_s,fx_N,fy_N,fz_N,qx,qy,qz,qw\n0,1,2,3,0,0,0,1\n1,4,5,6,0.6,0,0,0.8\n", 0.0, turned)
          .stroke;
  TableSettings settings;
  settings.position = turned;
  settings.force_sign = ForceSign::on_device;
  const Stroke one = import_stroke_text(
                         "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,qx,qy,qz,qw\n0,1,2,3,1,2,3,0,0,0,1\n"
                         "1,4,5,6,4,5,6,0.6,0,0,0.8\n",
                         "one.csv", settings)
                         .stroke;
  EXPECT_EQ(two.position, one.position);
  EXPECT_EQ(two.force, one.force);
  EXPECT_EQ(two.force[0], Vector3d(-2, 1, 3));
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(two.orientation[i].isApprox(one.orientation[i], 1e-15));
}

TEST_F(MergedTables, AForceWithoutAUnitIsAskedFor) {
  EXPECT_THAT(
      refusal("t_s,x_m,y_m\n0,0,0\n1,1,0\n",
              "t_s,wrench.force.x,wrench.force.y,wrench.force.z\n0,1,2,3\n1,4,5,6\n"),
      HasSubstr("second.csv: the unit of wrench.force.x, wrench.force.y, wrench.force.z is not known; "
                "give stroke.table.force_unit (stroke convert: --force-unit)"));
}

TEST_F(MergedTables, OrientationsTurnTheShortestWay) {
  const Stroke stroke =
      merged("t_s,x_m,y_m\n0,0,0\n1,1,0\n",
             "t_s,qx,qy,qz,qw\n0,0,0,0,1\n2,0,0,-0.70710678118654752,-0.70710678118654752\n")
          .stroke;
  const Quaterniond middle(stroke.orientation[1]);
  EXPECT_NEAR(middle.angularDistance(Quaterniond::Identity()), std::acos(half), 1e-9);  // 45 of 90 deg
  EXPECT_TRUE((middle * Vector3d(1, 0, 0)).isApprox(Vector3d(half, half, 0), 1e-9));
}

TEST_F(MergedTables, ClocksSayHowTimesBelongTogether) {
  const std::string first =
      "stamp,x_m,y_m\n1700000000000000000,0,0\n1700000000500000000,1,0\n1700000001000000000,2,0\n";
  const ImportedStroke both =
      merged(first, "stamp,fx_N,fy_N,fz_N\n1700000000250000000,1,0,0\n1700000002250000000,9,0,0\n");
  EXPECT_THAT(both.stroke.time, ElementsAre(0.5, 1.0));  // before, there is no force
  EXPECT_TRUE(both.stroke.force[0].isApprox(Vector3d(2, 0, 0), 1e-9));
  EXPECT_TRUE(both.stroke.force[1].isApprox(Vector3d(4, 0, 0), 1e-9));
  EXPECT_THAT(both.description,
              HasSubstr("begins +0.25 s after the first table begins, ends +1.25 s after it ends"));
  EXPECT_THAT(both.warnings,
              ElementsAre(HasSubstr("0.25 s at its beginning and 0 s at its end are left out")));

  const std::string early = "stamp,fx_N,fy_N,fz_N\n1699999998500000000,1,0,0\n1700000002500000000,9,0,0\n";
  EXPECT_TRUE(merged(first, early).stroke.force[0].isApprox(Vector3d(4, 0, 0), 1e-9));  // 1.5 s of 4

  EXPECT_THAT(refusal(first, "t_s,fx_N,fy_N,fz_N\n0,1,0,0\n2,1,0,0\n"), HasSubstr("--merge-shift"));
  EXPECT_EQ(merged(first, "t_s,fx_N,fy_N,fz_N\n7,1,0,0\n9,1,0,0\n", -7.0).stroke.size(), 3u);
  EXPECT_THAT(refusal("t_s,x_m,y_m\n0,0,0\n1,1,0\n", "t_s,fx_N,fy_N,fz_N\n7,1,0,0\n9,1,0,0\n"),
              HasSubstr("do not overlap"));
  EXPECT_THAT(refusal("t_s,x_m,y_m\n0,0,0\n1,1,0\n", "t_s,a,b\n7,1,0\n"),
              HasSubstr("no columns are named as a force"));
}

}  // namespace
}  // namespace sandstroke
