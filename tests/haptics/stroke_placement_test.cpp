#include "haptics/stroke_placement.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/error.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

Stroke stroke_through(const std::vector<Vector3d>& points) {
  Stroke stroke;
  stroke.position = points;
  for (std::size_t i = 0; i < points.size(); ++i) stroke.time.push_back(5.0 + 0.01 * static_cast<double>(i));
  return stroke;
}

/// A flat spiral, 0.3 m wide.
std::vector<Vector3d> flat_tracing() {
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i)
    points.emplace_back(0.001 * i * std::cos(0.1 * i), 0.0007 * i * std::sin(0.1 * i), 0.0);
  return points;
}

std::string complaint(const Stroke& stroke, const StrokePlacement& placement) {
  try {
    place_stroke(stroke, placement, "hand.h5");
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

TEST(StrokePlacement, MovesOnlyTimeByDefault) {
  const Stroke stroke = stroke_through(flat_tracing());
  const Stroke placed = place_stroke(stroke, {});
  EXPECT_EQ(placed.position, stroke.position);
  EXPECT_EQ(placed.time.front(), 0.0);
  EXPECT_NEAR(placed.time.back(), 1.99, 1e-12);
}

TEST(StrokePlacement, ScaleThenTurnThenDepthThenOffset) {
  Stroke stroke = stroke_through({{1, 0, 0.5}});
  stroke.velocity = {{3, 0, 1}};
  stroke.force = {{0, 4, 2}};
  StrokePlacement placement;
  placement.scale = 2.0;
  placement.rotate_z = 90.0;
  placement.depth = 0.25;
  placement.offset = {10, 20, 30};
  const Stroke placed = place_stroke(stroke, placement);
  EXPECT_LT((placed.position[0] - Vector3d(10, 22, 30.75)).norm(), 1e-14);
  EXPECT_LT((placed.velocity[0] - Vector3d(0, 6, 2)).norm(), 1e-14);  // turned and scaled
  EXPECT_LT((placed.force[0] - Vector3d(-4, 0, 2)).norm(), 1e-14);    // turned only
}

TEST(StrokePlacement, ATiltedPlaneIsLaidLevelAtTheDepth) {
  const Eigen::Matrix3d tilt =
      (Eigen::AngleAxisd(0.7, Vector3d(1, 2, 0.3).normalized()) * Eigen::AngleAxisd(2.0, Vector3d::UnitZ()))
          .toRotationMatrix();
  std::vector<Vector3d> points = flat_tracing();
  for (Vector3d& p : points) p = tilt * p + Vector3d(0.5, -0.3, 0.8);
  Stroke stroke = stroke_through(points);
  stroke.force.assign(points.size(), tilt * Vector3d(0, 0, 2));  // along the normal
  StrokePlacement placement;
  placement.plane = StrokePlane::fit;
  placement.depth = 0.004;
  const Stroke placed = place_stroke(stroke, placement);

  Vector3d low = placed.position[0], high = low;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    EXPECT_NEAR(placed.position[i].z(), -0.004, 1e-12);
    EXPECT_LT((placed.force[i] - Vector3d(0, 0, 2)).norm(), 1e-12);
    low = low.cwiseMin(placed.position[i]);
    high = high.cwiseMax(placed.position[i]);
    // A rigid motion keeps every distance.
    const double distance = (placed.position[i] - placed.position[0]).norm();
    EXPECT_NEAR(distance, (points[i] - points[0]).norm(), 1e-12);
  }
  EXPECT_NEAR(low.x() + high.x(), 0.0, 1e-15);
  EXPECT_NEAR(low.y() + high.y(), 0.0, 1e-15);
}

TEST(StrokePlacement, ALevelPlaneIsOnlyShifted) {
  std::vector<Vector3d> points = flat_tracing();
  for (Vector3d& p : points) p.z() = 0.26;
  const Stroke stroke = stroke_through(points);
  StrokePlacement placement;
  placement.plane = StrokePlane::fit;
  const Stroke placed = place_stroke(stroke, placement);
  const Vector3d shift = placed.position[0] - points[0];
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT((placed.position[i] - points[i] - shift).norm(), 1e-14);
}

TEST(StrokePlacement, BumpsAboutThePlaneStayAndScale) {
  // Heights +1 mm and -1 mm at the corners of a square, alternating: the best plane is the middle one.
  const Stroke stroke = stroke_through({{0, 0, 0.101}, {0.1, 0, 0.099}, {0.1, 0.1, 0.101}, {0, 0.1, 0.099}});
  StrokePlacement placement;
  placement.plane = StrokePlane::fit;
  placement.scale = 3.0;
  placement.depth = 0.01;
  const Stroke placed = place_stroke(stroke, placement);
  const double expected[] = {-0.007, -0.013, -0.007, -0.013};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(placed.position[i].z(), expected[i], 1e-14);
}

TEST(StrokePlacement, OnlySamplesWithThePenDownMakeThePlane) {
  std::vector<Vector3d> points = flat_tracing();
  const std::size_t drawn = points.size();
  points.emplace_back(7, 8, 9);
  Stroke stroke = stroke_through(points);
  stroke.contact.assign(drawn, pen_down);
  stroke.contact.push_back(pen_up);
  StrokePlacement placement;
  placement.plane = StrokePlane::fit;
  const Stroke placed = place_stroke(stroke, placement);
  for (std::size_t i = 0; i < drawn; ++i) EXPECT_NEAR(placed.position[i].z(), 0.0, 1e-14);
  EXPECT_NEAR(placed.position[drawn].z(), 9.0, 1e-12);
}

TEST(StrokePlacement, CutsBySamplesAndLetsTimeBeginAtZero) {
  Stroke stroke = stroke_through(flat_tracing());
  stroke.contact.assign(stroke.size(), pen_down);
  for (std::size_t i = 0; i < stroke.size(); ++i) stroke.switches.push_back(static_cast<std::uint32_t>(i));
  StrokePlacement placement;
  placement.start = 0.495;  // between samples 49 and 50
  placement.stop = 1.005;   // between samples 100 and 101
  const Stroke placed = place_stroke(stroke, placement);
  ASSERT_EQ(placed.size(), 51u);
  EXPECT_EQ(placed.contact.size(), 51u);
  EXPECT_EQ(placed.switches.front(), 50u);
  EXPECT_EQ(placed.switches.back(), 100u);
  EXPECT_EQ(placed.position.front(), stroke.position[50]);
  EXPECT_EQ(placed.time.front(), 0.0);
}

TEST(StrokePlacement, SaysWhatCannotBePlaced) {
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  EXPECT_THAT(complaint(stroke_through({{0, 0, 0}, {1, 0, 0}}), fit), HasSubstr("hand.h5"));
  EXPECT_THAT(complaint(stroke_through({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}}), fit),
              HasSubstr("one line"));
  EXPECT_THAT(complaint(stroke_through({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), fit), HasSubstr("plane"));
  Stroke lifted = stroke_through(flat_tracing());
  lifted.contact.assign(lifted.size(), pen_up);
  EXPECT_THAT(complaint(lifted, fit), HasSubstr("0 samples with the pen down"));

  StrokePlacement late;
  late.start = 100.0;
  EXPECT_THAT(complaint(stroke_through(flat_tracing()), late), HasSubstr("start = 100 s"));
  StrokePlacement none;
  none.scale = 0.0;
  EXPECT_THAT(complaint(stroke_through(flat_tracing()), none), HasSubstr("scale is 0"));
}

/// A plunge, a drag along a line and a lift lie in an upright plane: level, the drag would lie on its side.
TEST(StrokePlacement, RefusesAPlaneThatIsNoTable) {
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  std::vector<Vector3d> drag;
  for (int i = 0; i <= 40; ++i) drag.emplace_back(-0.1, 0.0, 0.001 * (40 - i));
  for (int i = 0; i <= 100; ++i) drag.emplace_back(0.002 * i - 0.1, 0.0, 0.0);
  for (int i = 0; i <= 40; ++i) drag.emplace_back(0.1, 0.0, 0.001 * i);
  EXPECT_THAT(
      complaint(stroke_through(drag), fit),
      testing::AllOf(HasSubstr("hand.h5"), HasSubstr("tilted 90 deg"), HasSubstr("stroke.plane = \"keep\"")));
  const auto tilted = [](double degrees) {
    std::vector<Vector3d> points = flat_tracing();
    const Eigen::AngleAxisd tilt(degrees * std::numbers::pi / 180.0, Vector3d(3, -4, 0) / 5.0);
    for (Vector3d& p : points) p = tilt * p;
    return stroke_through(points);
  };
  for (const double degrees : {-44.9, 0.0, 44.9, 180.0, -45.1, 45.1, 134.9})
    EXPECT_EQ(complaint(tilted(degrees), fit), "");
  // Along x, as thick as it is wide: any plane through the line would do.
  std::vector<Vector3d> rod;
  for (int i = 0; i < 400; ++i) rod.emplace_back(0.001 * i, 0.001 * std::cos(i), 0.001 * std::sin(i));
  EXPECT_THAT(complaint(stroke_through(rod), fit),
              testing::AllOf(HasSubstr("twice as wide"), HasSubstr("0.706 mm rms, 1 mm at most"),
                             HasSubstr("\"flatten\"")));
}

/// The axes of a frame with another one up: as they lie, z is that axis.
Eigen::Matrix3d lying(const Vector3d& up) {
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), up).toRotationMatrix();
}

TEST(StrokePlacement, APlaneWithAnyAxisUpIsLaidLevel) {
  // Whatever is up, the spiral is seen from above as it was drawn, up to a turn about the normal: never
  // mirrored.
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  fit.depth = 0.004;
  const std::vector<Vector3d> flat = flat_tracing();
  const auto signed_area = [](const std::vector<Vector3d>& points) {
    double area = 0.0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) area += points[i].cross(points[i + 1]).z();
    return area;
  };
  for (const Vector3d& up : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0.05, 0.98, -0.1)}) {
    std::vector<Vector3d> points = flat;
    for (Vector3d& p : points) p = lying(up) * p + Vector3d(0.4, 0.1, 0.9);
    const Stroke placed = place_stroke(stroke_through(points), fit);
    for (const Vector3d& p : placed.position) EXPECT_NEAR(p.z(), -0.004, 1e-12);
    EXPECT_NEAR(placed.position[150].head<2>().norm() > 0.0 ? signed_area(placed.position) : 0.0,
                signed_area(flat), 0.05 * std::abs(signed_area(flat)));
  }
}

TEST(StrokePlacement, TheSideThatIsUpIsThatOfTheLiftsOrTheOneNamed) {
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  for (const double side : {1.0, -1.0}) {
    std::vector<Vector3d> points = flat_tracing();
    points.emplace_back(0.0, 0.0, 0.05 * side);
    for (Vector3d& p : points) p = lying(Vector3d::UnitY()) * p;
    Stroke lifted = stroke_through(points);
    lifted.contact.assign(points.size(), pen_down);
    lifted.contact.back() = pen_up;
    EXPECT_NEAR(place_stroke(lifted, fit).position.back().z(), 0.05, 1e-12);
    // Without the pen's state the named axis decides.
    fit.up = side > 0.0 ? StrokeUp::y : StrokeUp::minus_y;
    lifted.contact.pop_back();
    lifted.time.pop_back();
    lifted.position.pop_back();
    lifted.force.assign(lifted.size(), Vector3d(0, side, 0));
    EXPECT_NEAR(place_stroke(lifted, fit).force[0].z(), 1.0, 1e-12);
    fit.up = StrokeUp::automatic;
  }
}

TEST(StrokePlacement, AnAxisThatIsNotUpIsRefused) {
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  fit.up = StrokeUp::x;
  EXPECT_THAT(complaint(stroke_through(flat_tracing()), fit),
              testing::AllOf(HasSubstr("tilted 90 deg against stroke.up = \"x\""), HasSubstr("\"z\"")));
}

TEST(StrokePlacement, ANamedAxisIsWithin45DegOfTheNormal) {
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  fit.up = StrokeUp::z;
  for (const double degrees : {44.0, 46.0, 134.0, 136.0}) {
    std::vector<Vector3d> points = flat_tracing();
    const Eigen::AngleAxisd tilt(degrees * std::numbers::pi / 180.0, Vector3d::UnitX());
    for (Vector3d& p : points) p = tilt * p;
    EXPECT_EQ(complaint(stroke_through(points), fit).empty(), degrees == 44.0 || degrees == 136.0) << degrees;
  }
}

TEST(StrokePlacement, FlattenMovesWhatIsDrawnOntoThePlaneAndNothingElse) {
  // A bumpy tracing, and one that is as thick as it is wide.
  std::vector<Vector3d> points = flat_tracing();
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].z() = 0.003 * std::sin(2.0 * static_cast<double>(i));
  const Stroke bumpy = stroke_through(points);
  StrokePlacement placement;
  placement.depth = 0.005;
  placement.plane = StrokePlane::fit;
  const Stroke fitted = place_stroke(bumpy, placement);
  placement.plane = StrokePlane::flatten;
  const Stroke flat = place_stroke(bumpy, placement);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(flat.position[i].z(), -0.005);
    EXPECT_EQ(flat.position[i].head<2>(), fitted.position[i].head<2>());
  }
}

TEST(StrokePlacement, FillsItsFractionOfTheBedCentredAndFitted) {
  std::vector<Vector3d> points = flat_tracing();
  for (Vector3d& p : points) p += Vector3d(3, -2, 0.25);
  points.emplace_back(50, 60, 70);  // in the air
  Stroke stroke = stroke_through(points);
  stroke.contact.assign(points.size(), pen_down);
  stroke.contact.back() = pen_up;
  const Eigen::AlignedBox2d bed(Eigen::Vector2d(0.5, 1.0), Eigen::Vector2d(1.5, 1.5));  // 1 m by 0.5 m
  for (const double angle : {0.0, 35.0, 90.0}) {
    StrokePlacement placement;
    placement.place = StrokePlace::centre;
    placement.fit = 0.8;
    placement.rotate_z = angle;
    placement.depth = 0.01;
    placement.offset = {0.1, 0.0, 0.0};
    const Stroke placed = place_stroke(stroke, placement, "hand.h5", bed);
    Eigen::AlignedBox3d extent;
    for (std::size_t i = 0; i + 1 < placed.size(); ++i) extent.extend(placed.position[i]);
    EXPECT_LT((extent.center().head<2>() - Eigen::Vector2d(1.1, 1.25)).norm(), 1e-12);
    const Eigen::Vector2d fraction = extent.sizes().head<2>().cwiseQuotient(bed.sizes());
    EXPECT_NEAR(fraction.maxCoeff(), 0.8, 1e-12);
    EXPECT_LT(fraction.minCoeff(), 0.8);
    // One scale for all three coordinates.
    const double scale = (placed.position[1] - placed.position[0]).norm() / (points[1] - points[0]).norm();
    EXPECT_NEAR(placed.position[0].z() + 0.01, 0.25 * scale, 1e-12);
  }
  StrokePlacement centred;
  centred.place = StrokePlace::centre;
  EXPECT_NEAR(place_stroke(stroke, centred, "hand.h5", bed).position[0].z(), 0.25, 1e-15);
  StrokePlacement fit;
  fit.fit = 0.5;
  EXPECT_THAT(complaint(stroke_through({{0, 0, 0}, {0, 0, -1}}), fit), HasSubstr("stroke.scale"));
}

/// A flat tracing 0.25 m up, whose pressure goes from 0 to 199 and whose force turns and is twice as large.
Stroke pressed_tracing() {
  std::vector<Vector3d> points = flat_tracing();
  for (Vector3d& p : points) p.z() += 0.25;
  Stroke stroke = stroke_through(points);
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const auto pressure = static_cast<double>(i);
    stroke.pressure.push_back(pressure);
    stroke.force.emplace_back(2.0 * pressure * Vector3d(std::sin(0.3 * pressure), 0.6, -0.8).normalized());
  }
  return stroke;
}

TEST(StrokePlacement, DepthIsAsTheHandPresses) {
  const Stroke stroke = pressed_tracing();
  StrokePlacement placement;
  placement.depth = 0.004;
  for (const DepthBy by : {DepthBy::pressure, DepthBy::force})
    for (const StrokePlane plane : {StrokePlane::keep, StrokePlane::fit, StrokePlane::flatten}) {
      placement.depth_by = by;
      placement.plane = plane;
      const Stroke placed = place_stroke(stroke, placement);
      const double surface = plane == StrokePlane::keep ? 0.25 : 0.0;
      for (std::size_t i = 0; i < stroke.size(); ++i)
        EXPECT_NEAR(placed.position[i].z(), surface - 0.004 * static_cast<double>(i) / 199.0, 1e-12);
    }
  EXPECT_EQ(place_stroke(stroke, placement).pressure, stroke.pressure);
}

TEST(StrokePlacement, FullDepthIsThatOfTheWholeStrokeOrOfWhatIsNamed) {
  Stroke stroke = pressed_tracing();
  StrokePlacement placement;
  placement.depth = 0.004;
  placement.plane = StrokePlane::flatten;
  placement.depth_by = DepthBy::pressure;
  placement.stop = 1.0;  // a part goes as deep as in the whole
  EXPECT_NEAR(place_stroke(stroke, placement).position.back().z(), -0.004 * 100 / 199, 1e-12);
  placement.full_depth_at = 50.0;  // more goes no deeper
  EXPECT_NEAR(place_stroke(stroke, placement).position.back().z(), -0.004, 1e-12);
  EXPECT_NEAR(place_stroke(stroke, placement).position[25].z(), -0.002, 1e-12);
  stroke.pressure[25] = -3.0;  // a pen at rest that is badly calibrated
  EXPECT_NEAR(place_stroke(stroke, placement).position[25].z(), 0.0, 1e-12);
  // Nothing presses in the air.
  stroke.contact.assign(stroke.size(), pen_down);
  stroke.contact[199] = pen_up;
  placement.full_depth_at = 0.0;
  EXPECT_NEAR(place_stroke(stroke, placement).position[99].z(), -0.004 * 99 / 198, 1e-12);
}

TEST(StrokePlacement, SaysWhyNoDepthFollowsThePressure) {
  StrokePlacement placement;
  placement.depth = 0.004;
  placement.depth_by = DepthBy::pressure;
  const Stroke flat = stroke_through(flat_tracing());
  EXPECT_THAT(complaint(flat, placement), testing::AllOf(HasSubstr("hand.h5"), HasSubstr("no pressure"),
                                                         HasSubstr("stroke.table.pressure")));
  Stroke bumpy = pressed_tracing();
  bumpy.position[7].z() += 1e-6;
  EXPECT_THAT(complaint(bumpy, placement), HasSubstr("stroke.plane = \"fit\" or \"flatten\""));
  Stroke idle = pressed_tracing();
  idle.pressure.assign(idle.size(), 0.0);
  EXPECT_THAT(complaint(idle, placement), HasSubstr("pressure above 0"));
  placement.depth_by = DepthBy::force;
  EXPECT_THAT(complaint(flat, placement),
              testing::AllOf(HasSubstr("no force"), HasSubstr("stroke.table.force")));
}

/// Points of an ellipse, so wide and so thick along the axes of a turned frame.
Stroke ellipsoid(double length, double width, double thickness) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) {  // the three factors are orthogonal: their squares' means are 1/2
    const double angle = 2.0 * std::numbers::pi * i / 60;
    points.emplace_back(length * std::cos(angle), width * std::sin(angle), thickness * std::cos(2.0 * angle));
  }
  return stroke_through(points);
}

TEST(StrokePlacement, FitsAPlaneToWhatIsWideEnoughAndThinEnough) {
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  struct Case {
    double width, thickness;
    const char* complaint;
  };
  for (const Case& one : {Case{0.1, 0.95 * 0.05, ""},
                          {0.1, 1.05 * 0.05, "twice as wide"},  // half as thick as wide
                          {0.3, 0.95 * 0.15, ""},
                          {0.3, 1.05 * 0.15, "twice as wide"},
                          {1.05e-6, 0.0, ""},
                          {0.95e-6, 0.0, "one line"}})  // a millionth as wide as long
    EXPECT_THAT(complaint(ellipsoid(1.0, one.width, one.thickness), fit),
                *one.complaint ? testing::Matcher<std::string>(HasSubstr(one.complaint)) : testing::Eq(""))
        << one.width << ", " << one.thickness;
}

TEST(StrokePlacement, TheFitBeginsWithThreeSamples) {
  StrokePlacement fit;
  fit.plane = StrokePlane::fit;
  EXPECT_EQ(complaint(stroke_through({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}), fit), "");
  EXPECT_THAT(complaint(stroke_through({{0, 0, 1}, {1, 0, 1}}), fit), HasSubstr("2 samples"));
}

TEST(StrokePlacement, ASampleAtTheCutIsKept) {
  Stroke stroke = stroke_through(std::vector<Vector3d>(9, Vector3d::Zero()));
  for (std::size_t i = 0; i < 9; ++i) {
    stroke.time[i] = 4.0 + 0.25 * static_cast<double>(i);  // exact
    stroke.flags.push_back(static_cast<std::uint32_t>(i));
    stroke.velocity.emplace_back(static_cast<double>(i), 0, 0);
    stroke.force.emplace_back(0, static_cast<double>(i), 0);
  }
  struct Case {
    double start, stop;
    std::uint32_t first, last;
  };
  for (const Case& one : {Case{0.5, 1.5, 2, 6},
                          {0.95 * 0.5, 0.95 * 1.5, 2, 5},
                          {1.05 * 0.5, 1.05 * 1.5, 3, 6},
                          {0.0, 0.0, 0, 0},
                          {2.0, 3.0, 8, 8}}) {
    StrokePlacement placement;
    placement.start = one.start;
    placement.stop = one.stop;
    const Stroke placed = place_stroke(stroke, placement);
    ASSERT_EQ(placed.size(), one.last - one.first + 1u) << one.start;
    EXPECT_EQ(placed.time.front(), 0.0);
    EXPECT_EQ(placed.time.back(), 0.25 * (one.last - one.first));
    EXPECT_EQ(placed.flags.front(), one.first);
    EXPECT_EQ(placed.flags.back(), one.last);
    EXPECT_EQ(placed.velocity.front().x(), one.first);
    EXPECT_EQ(placed.force.back().y(), one.last);
  }
  StrokePlacement nothing;
  nothing.start = 1.05 * 0.5;
  nothing.stop = 0.95 * 0.75;
  EXPECT_THAT(complaint(stroke, nothing), HasSubstr("no sample lies between"));
}

TEST(StrokePlacement, MovesAPointAsTheStrokesPoint) {
  Stroke stroke = stroke_through({{0.1, -0.2, 0.3}});
  stroke.frame = "device";
  StrokePlacement placement;
  placement.scale = 3.0;
  placement.rotate_z = 25.0;
  placement.depth = 0.07;
  placement.offset = {1.0, 2.0, 4.0};
  const PointPlacement point = point_placement(placement, "device");
  EXPECT_LT((point.position(stroke.position[0]) - place_stroke(stroke, placement).position[0]).norm(), 1e-15);
  // A force does no other work along the hand's way than along the tip's, but for the scale.
  const Vector3d force(0.5, 0.25, -2.0), way(0.01, 0.03, -0.02);
  const Vector3d tips_way = point.position(stroke.position[0] + way) - point.position(stroke.position[0]);
  EXPECT_NEAR(3.0 * point.force_back(force).dot(way), force.dot(tips_way), 1e-15);
  EXPECT_NEAR(point.force_back(force).norm(), force.norm(), 1e-15);
}

TEST(PlaceStroke, TurnsDeviceAxesToTheBeds) {
  Stroke stroke;  // +x towards the operator, who sits at the bed's -y; +y to the operator's right
  stroke.frame = "device";
  stroke.time = {0.0, 1.0};
  stroke.position = {{1.0, 0.0, 0.5}, {0.0, 1.0, 0.5}};
  stroke.force = {{1.0, 0.0, 0.0}, {0.0, 0.0, 2.0}};
  const Stroke placed = place_stroke(stroke, StrokePlacement{});
  EXPECT_EQ(placed.position[0], Eigen::Vector3d(0.0, -1.0, 0.5));
  EXPECT_EQ(placed.position[1], Eigen::Vector3d(1.0, 0.0, 0.5));
  EXPECT_EQ(placed.force[0], Eigen::Vector3d(0.0, -1.0, 0.0));
}

TEST(StrokePlacement, TimesMadeForASpeedAreThoseOfTheSizeOnTheBed) {
  Stroke line;
  line.time = {0.0, 1.0, 2.0};
  line.position = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}};
  line.velocity.assign(3, {0.5, 0, 0});
  line.gap_threshold = 1.5;
  StrokePlacement placement;
  placement.fit = 0.8;
  const Eigen::AlignedBox2d bed(Eigen::Vector2d(-0.1, -0.1), Eigen::Vector2d(0.1, 0.1));
  EXPECT_EQ(place_stroke(line, placement, "recorded", bed).time, line.time);
  line.tip_speed = 0.5;
  const Stroke placed = place_stroke(line, placement, "made", bed);
  EXPECT_NEAR(placed.duration(), 0.16 / 0.5, 1e-12);
  EXPECT_NEAR(placed.velocity[1].x(), 0.5, 1e-12);
  EXPECT_TRUE(placed.joined(0) && placed.joined(1));
  placement.fit = 0.0;
  placement.scale = 3.0;
  placement.speed = 2.0;
  EXPECT_NEAR(place_stroke(line, placement).duration(), 3.0 / 0.5 / 2.0, 1e-12);
}

TEST(StrokePlane, AnApproachThatPullsThePlaneIsTold) {
  Stroke circle;
  for (int i = 0; i < 1000; ++i) {
    circle.time.push_back(0.01 * i);
    circle.position.emplace_back(0.05 * std::cos(0.01 * i), 0.05 * std::sin(0.01 * i),
                                 1e-4 * std::sin(0.3 * i));
  }
  EXPECT_EQ(off_plane_warning(circle, "hand"), "");
  const Stroke level = circle;
  for (const std::size_t approach : {20u, 50u, 150u}) {
    circle = level;
    for (std::size_t i = 0; i < approach; ++i)
      circle.position[i].z() += 0.03 * (1.0 - static_cast<double>(i) / static_cast<double>(approach));
    EXPECT_NE(off_plane_warning(circle, "hand").find("stroke.start and stroke.stop"), std::string::npos)
        << approach;
    circle.contact.assign(1000, pen_down);
    for (std::size_t i = 0; i < approach; ++i) circle.contact[i] = pen_up;
    EXPECT_EQ(off_plane_warning(circle, "hand"), "");
  }
}

}  // namespace
}  // namespace sandstroke
