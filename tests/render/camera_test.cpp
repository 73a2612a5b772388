#include "render/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace sandstroke {
namespace {

const Eigen::AlignedBox3d bed(Eigen::Vector3d(-1.0, -1.0, -0.05), Eigen::Vector3d(1.0, 1.0, 0.1));

Eigen::Vector3d in_picture(const Camera& camera, const Eigen::Vector3d& position) {
  return (camera.to_clip * position.homogeneous()).hnormalized();
}

struct Extent {
  double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
};
Extent extent(const Camera& camera, const Eigen::AlignedBox3d& box) {
  Extent e;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p = in_picture(camera, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
    e = {std::min(e.left, p.x()), std::max(e.right, p.x()), std::min(e.low, p.y()), std::max(e.high, p.y())};
  }
  return e;
}

TEST(Camera, OverviewFramesTheSubjectTightlyFromEveryAngle) {
  for (const double azimuth : {-170.0, -70.0, 0.0, 45.0, 133.0}) {
    for (const double elevation : {5.0, 40.0, 90.0}) {
      for (const auto& [width, height] : {std::pair{1280, 720}, {500, 900}}) {
        ViewSettings view;
        view.azimuth = azimuth;
        view.elevation = elevation;
        view.width = width;
        view.height = height;
        const Extent e = extent(make_camera(view, bed, bed), bed);
        EXPECT_GE(e.left, -0.9 - 1e-9);
        EXPECT_LE(e.right, 0.9 + 1e-9);
        EXPECT_GE(e.low, -0.9 - 1e-9);
        EXPECT_LE(e.high, 0.9 + 1e-9);
        // It touches the free border on both sides of at least one direction.
        EXPECT_NEAR(std::max(e.right - e.left, e.high - e.low), 1.8, 1e-9) << azimuth << " " << elevation;
      }
    }
  }
}

TEST(Camera, LeavesAsMuchFreeAboveAsBelowAndLeftAsRight) {
  const Eigen::AlignedBox3d wide(Eigen::Vector3d(-0.6, -0.2, -0.01), Eigen::Vector3d(0.7, 0.1, 0.01));
  for (const double azimuth : {-100.0, -75.0, 0.0, 45.0})
    for (const double distance : {0.0, 2.5, 5.0})
      for (const double margin : {0.0, 0.15}) {
        ViewSettings view;
        view.name = ViewName::stroke;
        view.azimuth = azimuth;
        view.elevation = 38.0;
        view.distance = distance;
        const Extent e = extent(make_camera(view, wide, bed, margin), wide);
        EXPECT_NEAR(e.low, -e.high, 1e-9) << azimuth << " " << distance;
        EXPECT_NEAR(e.left, -e.right - 2.0 * margin, 1e-9) << azimuth << " " << distance;
      }
}

TEST(Camera, GoesStraightAtTheSubjectFromWhereItFits) {
  ViewSettings view;
  view.name = ViewName::overview;
  const Camera fits = make_camera(view, bed, bed);
  const double whole = (fits.eye - bed.center()).dot(-fits.forward);
  view.distance = whole;
  EXPECT_LT((make_camera(view, bed, bed).eye - fits.eye).norm(), 1e-9);
  for (const double part : {0.999, 0.6, 0.3, 0.1}) {
    view.distance = part * whole;
    const Camera nearer = make_camera(view, bed, bed);
    EXPECT_LT((nearer.eye - (bed.center() + part * (fits.eye - bed.center()))).norm(), 1e-9) << part;
  }
}

TEST(Camera, LeavesTheRightMarginFree) {
  ViewSettings view;
  for (const ViewName name : {ViewName::overview, ViewName::top}) {
    view.name = name;
    EXPECT_LE(extent(make_camera(view, bed, bed, 0.2), bed).right, 0.9 - 0.4 + 1e-9);
  }
}

TEST(Camera, CustomStandsWhereItIsTold) {
  ViewSettings view;
  view.name = ViewName::custom;
  view.azimuth = -90.0;
  view.elevation = 30.0;
  view.distance = 2.0;
  view.target = {0.3, 0.1, 0.02};
  const Camera camera = make_camera(view, bed, bed);
  EXPECT_NEAR((camera.eye - Eigen::Vector3d(0.3, 0.1 - std::sqrt(3.0), 1.02)).norm(), 0.0, 1e-12);
  const Eigen::Vector3d target = in_picture(camera, view.target);
  EXPECT_NEAR(target.x(), 0.0, 1e-12);
  EXPECT_NEAR(target.y(), 0.0, 1e-12);
  // Looking along +y, x goes to the right and z up.
  EXPECT_GT(in_picture(camera, {0.4, 0.1, 0.02}).x(), 0.0);
  EXPECT_GT(in_picture(camera, {0.3, 0.1, 0.1}).y(), 0.0);
}

TEST(Camera, FieldOfViewIsVertical) {
  ViewSettings view;
  view.name = ViewName::custom;
  view.azimuth = -90.0;
  view.elevation = 0.0;
  view.distance = 1.0;
  view.field_of_view = 90.0;
  const Camera camera = make_camera(view, bed, bed);
  EXPECT_NEAR(in_picture(camera, {0.0, 0.0, 1.0}).y(), 1.0, 1e-12);
  EXPECT_NEAR(in_picture(camera, {16.0 / 9.0, 0.0, 0.0}).x(), 1.0, 1e-12);
  EXPECT_NEAR(camera.scale, 360.0, 1e-9);  // at 1 m, 2 m fill 720 pixels
}

TEST(Camera, TopIsAMapWithEqualScales) {
  ViewSettings view;
  view.name = ViewName::top;
  const Camera camera = make_camera(view, bed, bed);
  EXPECT_TRUE(camera.orthographic);
  const Extent e = extent(camera, bed);
  EXPECT_NEAR(e.low, -0.9, 1e-12);
  EXPECT_NEAR(e.high, 0.9, 1e-12);
  EXPECT_NEAR(e.right - e.left, 1.8 * 720.0 / 1280.0, 1e-12);
  EXPECT_NEAR(in_picture(camera, {0.0, 0.5, 0.0}).y(), in_picture(camera, {0.0, 0.5, -0.05}).y(), 1e-12);
  EXPECT_NEAR(camera.pixels_per_metre(bed), 0.9 * 720.0 / 2.0, 1e-9);
}

TEST(Camera, TheSceneIsInsideTheDepthRange) {
  for (const ViewName name : {ViewName::overview, ViewName::top}) {
    ViewSettings view;
    view.name = name;
    const Camera camera = make_camera(view, bed, bed);
    for (int i = 0; i < 8; ++i)
      EXPECT_LT(std::abs(in_picture(camera, bed.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i))).z()),
                1.0);
  }
}

TEST(Camera, MissesWhatIsOutsideThePictureOnly) {
  ViewSettings view;
  view.name = ViewName::custom;
  view.azimuth = -90.0;
  view.elevation = 20.0;
  view.distance = 0.5;
  const Camera camera = make_camera(view, bed, bed);
  EXPECT_FALSE(camera.misses(bed));
  EXPECT_FALSE(camera.misses(
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.01, -0.01, 0.0), Eigen::Vector3d(0.01, 0.01, 0.01))));
  EXPECT_TRUE(camera.misses(Eigen::AlignedBox3d(Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, -0.9, 0.01))));
  EXPECT_TRUE(camera.misses(Eigen::AlignedBox3d(Eigen::Vector3d(0.9, 0, 0), Eigen::Vector3d(1, 0.1, 0.01))));
}

TEST(Camera, LevelGroundMovesUnderAPixelByItsWidthOverTheSineOfTheView) {
  Camera camera;
  camera.orthographic = true;
  camera.scale = 500.0;
  camera.forward = {0.8, 0.0, -0.6};
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1.0, -1.0, 0.0), Eigen::Vector3d(1.0, 1.0, 0.1));
  EXPECT_GE(camera.widest_pixel(box, 0.0), 0.002 / 0.6);
  EXPECT_LE(camera.widest_pixel(box, 0.0), 4.0 * 0.002 / 0.6);
  // A slope that falls away by 0.5 is met at 0.6 - 0.5 * 0.8.
  EXPECT_NEAR(camera.widest_pixel(box, 0.5) / camera.widest_pixel(box, 0.0), 3.0, 1e-9);
  EXPECT_EQ(camera.widest_pixel(box, 0.75), std::numeric_limits<double>::infinity());  // edge-on
  camera.forward = Eigen::Vector3d::UnitX();
  EXPECT_EQ(camera.widest_pixel(box, 0.0), std::numeric_limits<double>::infinity());
}

TEST(Camera, PixelsOfABoxAreWhereItsCornersAreAndLittleMore) {
  Camera camera;  // x and y from -1 to 1 as they are
  const PixelRect pixels =
      camera.pixels_of({Eigen::Vector3d(-0.5, 0.0, 0.0), Eigen::Vector3d(0.5, 3.0, 0.2)}, 400, 200);
  EXPECT_NEAR(pixels.left, 100, 3);
  EXPECT_LE(pixels.left, 99);
  EXPECT_NEAR(pixels.right, 300, 3);
  EXPECT_GE(pixels.right, 301);
  EXPECT_NEAR(pixels.bottom, 100, 3);
  EXPECT_EQ(pixels.top, 200);  // no pixels are beyond the picture
}

TEST(Camera, NearerBoxesAreLarger) {
  ViewSettings view;
  const Camera camera = make_camera(view, bed, bed);
  const Eigen::Vector3d size(0.1, 0.1, 0.01), step = 0.1 * (camera.eye - bed.center());
  const Eigen::AlignedBox3d far(-size, size), near(step - size, step + size);
  EXPECT_GT(camera.pixels_per_metre(near), camera.pixels_per_metre(far));
}

TEST(Camera, RefusesImpossibleViews) {
  const auto refusal = [](auto change) -> std::string {
    ViewSettings view;
    change(view);
    try {
      make_camera(view, bed, bed);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refusal([](ViewSettings& v) { v.field_of_view = 0.0; }).find("field_of_view"), std::string::npos);
  EXPECT_NE(refusal([](ViewSettings& v) { v.elevation = 91.0; }).find("elevation"), std::string::npos);
  EXPECT_NE(refusal([](ViewSettings& v) { v.distance = -1.0; }).find("distance"), std::string::npos);
  EXPECT_NE(refusal([](ViewSettings& v) { v.target.x() = std::nan(""); }).find("target"), std::string::npos);
}

}  // namespace
}  // namespace sandstroke
