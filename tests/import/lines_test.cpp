#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "haptics/stroke_sampler.h"
#include "import/import_stroke.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using Eigen::Vector2d;

ImportedStroke imported_path(const std::string& name, const std::string& text,
                             const TableSettings& settings) {
  const TestFolder folder;
  put_text(folder / name, text);
  return import_stroke(folder / name, settings);
}

/// A square of 120 mm at 30 mm/s takes 16 s, and its corners come 4 s apart.
TEST(Lines, ASquareOfGcodeIsDrawnAsASquare) {
  const Stroke stroke =
      imported_path("square.gcode", "G21 G90\nG0 X-60 Y-60 Z-4\nG1 X60 F1800\nY60\nX-60\nY-60\n", {}).stroke;
  StrokeSampler sampler(stroke);
  EXPECT_NEAR(stroke.duration(), 16.0, 1e-9);
  ASSERT_TRUE(sampler.gaps().empty());
  double off = 0.0, off_corner = 1.0;
  for (int i = 0; i <= 16000; ++i) {
    const Hand hand = sampler.at(std::min(0.001 * i, stroke.duration()));
    ASSERT_TRUE(hand.down);
    EXPECT_DOUBLE_EQ(hand.position.z(), -0.004);
    const Vector2d at = hand.position.head<2>().cwiseAbs();
    off = std::max(off, std::abs(at.maxCoeff() - 0.06));
    off_corner = std::min(off_corner, (at - Vector2d(0.06, 0.06)).norm());
  }
  EXPECT_LE(off, 1e-5);
  EXPECT_LE(off_corner, 1e-5);
}

/// theta stays: straight out and back in, then straight out elsewhere.
TEST(Lines, ARadiusOfAThrIsStraight) {
  TableSettings settings;
  settings.position_unit = "0.2";
  settings.speed = 0.05;
  const Stroke stroke = imported_path("star.thr", "0 0\n0 1\n0 0\n1 0\n1 0.9\n1 0.1\n", settings).stroke;
  StrokeSampler sampler(stroke);
  ASSERT_TRUE(sampler.gaps().empty());
  EXPECT_NEAR(stroke.duration(), 0.2 * (1.0 + 1.0 + 0.9 + 0.8) / 0.05, 1e-9);
  const Vector2d out(std::sin(1.0), std::cos(1.0));
  for (double t = 0.0; t <= stroke.duration(); t += 0.001) {
    const Vector2d at = sampler.at(t).position.head<2>();
    const double off = t < 8.0 ? std::abs(at.x()) : std::abs(at.x() * out.y() - at.y() * out.x());
    EXPECT_LE(off, 6e-5) << t;
  }
}

}  // namespace
}  // namespace sandstroke
