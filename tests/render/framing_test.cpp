#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/change_picture.h"
#include "sand/initial_surface.h"

namespace sandstroke {
namespace {

constexpr std::array<double, 3> magenta = {1.0, 0.0, 1.0};

bool is_magenta(const std::uint8_t* pixel) { return pixel[0] == 255 && pixel[1] == 0 && pixel[2] == 255; }

/// Draws with the same renderer as the picture before, where that is of the same bed.
Image picture_of(const HeightField& surface, const RenderSubject& subject) {
  // Made here, as all statics go in turn: the renderer before the library that is loaded for it.
  static BedGeometry bed = surface;
  static auto renderer = std::make_unique<HeightFieldRenderer>(bed.rows(), bed.cols(), bed.cell_size());
  if (!bed.same_grid(surface)) {
    bed = surface;
    renderer = std::make_unique<HeightFieldRenderer>(bed.rows(), bed.cols(), bed.cell_size());
  }
  return renderer->render(surface, subject);
}

RenderSubject small_subject() {
  RenderSubject subject;
  subject.view.width = 640;
  subject.view.height = 360;
  return subject;
}

TEST(Framing, APitDeeperThanTheBoxChangesItsOwnPixelsOnly) {
  const HeightGrid flat = HeightGrid::Zero(200, 200);
  HeightGrid pit = flat;
  pit.block(2, 90, 24, 20) = -0.5;  // behind the wall that is seen; the box is 0.07 m deep
  for (const RenderStyle style : {RenderStyle::sand, RenderStyle::height, RenderStyle::difference}) {
    RenderSubject subject = small_subject();
    subject.view.style = style;
    subject.view.azimuth = -90.0;
    subject.view.elevation = 25.0;
    subject.start = start_heights(HeightField(flat, 0.01));
    subject.range = ValueRange{-0.5, 0.5};
    subject.difference = &flat;
    const Image without = picture_of(HeightField(flat, 0.01), subject);
    const HeightGrid change = pit - flat;
    subject.difference = &change;
    const Image with = picture_of(HeightField(pit, 0.01), subject);
    subject.box = false;
    subject.background = magenta;
    const Image sand = picture_of(HeightField(flat, 0.01), subject);
    int changed = 0;
    for (int y = 0; y < with.height; ++y) {
      for (int x = 0; x < with.width; ++x) {
        if (std::equal(with.pixel(x, y), with.pixel(x, y) + 3, without.pixel(x, y))) continue;
        ++changed;
        ASSERT_FALSE(is_magenta(sand.pixel(x, y))) << x << ", " << y;  // no hole in the box or its ground
        ASSERT_NEAR(x, 320, 90) << y;  // a tenth of the bed, and what sees less of the sky
      }
    }
    EXPECT_GT(changed, 200);
  }
}

TEST(Framing, FilmsAndOtherRunsOfASceneHaveOneCamera) {
  const HeightGrid level = HeightGrid::Constant(60, 80, 0.02);
  HeightGrid scratch = level, pit = level;
  scratch(30, 40) -= 0.001;
  pit.block(10, 20, 30, 30) -= 0.4;
  pit.block(50, 60, 5, 5) += 0.1;
  const HeightField start(level, 0.01), little(scratch, 0.01), much(pit, 0.01);
  for (const ViewName name : {ViewName::overview, ViewName::stroke, ViewName::top}) {
    ViewSettings view = small_subject().view;
    view.name = name;
    const CellRange stroke{20, 30, 20, 60};
    const Image before_little = picture_of(start, subject_of_change(start, little, stroke, view));
    const Image before_much = picture_of(start, subject_of_change(start, much, stroke, view));
    EXPECT_TRUE(before_little.rgb == before_much.rgb) << view_names[static_cast<std::size_t>(name)];
  }
}

TEST(Framing, TheRimOfARippledBedIsLevel) {
  SurfaceSettings ripples;
  ripples.kind = SurfaceKind::ripples;
  ripples.amplitude = 0.02;
  ripples.wavelength = 0.15;
  RenderSubject subject = small_subject();
  subject.view.azimuth = -90.0;
  subject.view.elevation = 0.0;  // the nearest edge is the highest line of the picture
  subject.background = magenta;
  const Image image = picture_of(make_surface(ripples, 200, 200, 0.01), subject);
  const auto top = [&](int x) {
    int y = 0;
    while (y < image.height && is_magenta(image.pixel(x, y))) ++y;
    return y;
  };
  int columns = 0;
  for (int x = 40; x < 600; ++x, ++columns) ASSERT_EQ(top(x), top(320)) << x;
  EXPECT_LT(top(320), 180);
  EXPECT_EQ(columns, 560);
}

/// The brightness of each pixel beside that of the same box under a sun in the zenith: 0.72 in full shadow.
struct Shadow {
  Shadow(const HeightField& surface, RenderSubject subject) {
    picture = picture_of(surface, subject);
    subject.view.light_elevation = 90.0;
    lit = picture_of(surface, subject);
    subject.background = magenta;
    mask = picture_of(surface, subject);
  }
  double at(int x, int y) const { return static_cast<double>(picture.pixel(x, y)[1]) / lit.pixel(x, y)[1]; }
  bool on_ground(int x, int y) const { return is_magenta(mask.pixel(x, y)); }
  Image picture, lit, mask;
};

TEST(Framing, TheShadowOfALongBoxHasStraightEdgesAlongTheLight) {
  RenderSubject subject = small_subject();
  subject.view.name = ViewName::custom;  // from straight above: the ground is seen to scale
  subject.view.azimuth = -90.0;
  subject.view.elevation = 90.0;
  subject.view.distance = 5.0;
  subject.view.target = {0.0, -0.3, 0.0};
  subject.view.light_azimuth = 145.0;
  subject.view.light_elevation = 6.0;
  const Shadow shadow(HeightField(20, 400, 0.01), subject);
  const auto left_edge = [&](int y) {  // in pixels, where it is half dark
    constexpr double half = 0.5 * (0.72 + 1.0);
    int x = 0;
    while (x < 600 && shadow.at(x + 1, y) > half) ++x;
    return x + (shadow.at(x, y) - half) / (shadow.at(x, y) - shadow.at(x + 1, y));
  };
  // Its 1.4 m begin at the wall, 0.15 m below the middle; a metre is 111 pixels.
  const double pi = 3.14159265358979323846, right_per_down = -1.0 / std::tan(145.0 * pi / 180.0);
  const int first = 190, last = 235;
  for (int y = first; y < last; ++y)
    EXPECT_NEAR(left_edge(y), left_edge(first) + (y - first) * right_per_down, 1.0) << y;
  EXPECT_TRUE(shadow.on_ground(static_cast<int>(left_edge(last)), last));
}

TEST(Framing, NoShadowIsCutOff) {
  RenderSubject subject = small_subject();
  subject.view.name = ViewName::custom;  // the shadow comes up to the camera, far before the box
  subject.view.azimuth = -90.0;
  subject.view.distance = 6.0;
  subject.view.light_azimuth = 110.0;
  subject.view.light_elevation = 4.0;
  const Shadow shadow(HeightField(40, 400, 0.01), subject);
  int dark = 0;
  for (int x = 0; x < 640; ++x) {
    for (int y = 1; y < 360; ++y) {
      if (!shadow.on_ground(x, y) || !shadow.on_ground(x, y - 1)) continue;
      dark += shadow.at(x, y) < 0.75;
      ASSERT_NEAR(shadow.at(x, y), shadow.at(x, y - 1), 0.15) << x << ", " << y;  // a penumbra, no step
    }
  }
  EXPECT_GT(dark, 10000);
}

}  // namespace
}  // namespace sandstroke
