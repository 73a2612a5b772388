#include "render/scale_bar.h"

#include <gtest/gtest.h>

#include "render/annotate.h"

namespace sandstroke {
namespace {

const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.5, -0.5, -0.05), Eigen::Vector3d(0.5, 0.5, 0.0));

ViewSettings view_of(ViewName name, double azimuth = -70.0) {
  ViewSettings view;
  view.name = name;
  view.azimuth = azimuth;
  view.width = 800;
  view.height = 600;
  return view;
}

TEST(ScaleBar, OfAMapIsARoundLengthByItsScale) {
  const Camera camera = make_camera(view_of(ViewName::top), box, box);
  const std::optional<ScaleBar> bar = scale_bar(camera, box, 800, 600);
  ASSERT_TRUE(bar);
  EXPECT_EQ(bar->length, 0.2);
  EXPECT_EQ(bar->label, "200 mm");
  EXPECT_NEAR((bar->to - bar->from).norm(), 0.2 * camera.scale, 1e-9);
}

TEST(ScaleBar, OfAnOverviewLiesBeforeTheNearSide) {
  for (const double azimuth : {-70.0, 10.0, 100.0, 200.0}) {
    const Camera camera = make_camera(view_of(ViewName::overview, azimuth), box, box);
    const std::optional<ScaleBar> bar = scale_bar(camera, box, 800, 600);
    ASSERT_TRUE(bar) << azimuth;
    EXPECT_LT(bar->from.x(), bar->to.x()) << azimuth << ": its label stands upright below it";
    EXPECT_GT(std::min(bar->from.y(), bar->to.y()), 300.0) << azimuth << ": in the lower half";
  }
}

TEST(ScaleBar, IsLeftOutWhereItsGroundIsNotInThePicture) {
  ViewSettings view = view_of(ViewName::custom);
  view.distance = 0.3;  // the camera looks at the middle of the bed from close by
  EXPECT_FALSE(scale_bar(make_camera(view, box, box), box, 800, 600));
}

TEST(ScaleBar, IsDrawnFromEndToEnd) {
  Image image(200, 100);
  std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{255});
  draw_scale_bar(image, {{20.0, 80.0}, {150.0, 80.0}, {20.0, 60.0}, 0.1, "100 mm"});
  for (const int x : {20, 80, 149}) EXPECT_LT(image.pixel(x, 80)[0], 120) << x;
  EXPECT_EQ(image.pixel(160, 80)[0], 255);
}

TEST(ScaleBar, KeepsItsLabelAwayFromItFromEverySide) {
  int bars = 0;
  for (const auto& [name, elevation] : {std::pair{ViewName::overview, 40.0},
                                        {ViewName::overview, 20.0},
                                        {ViewName::overview, 90.0},
                                        {ViewName::top, 0.0}})
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 15.0) {
      SCOPED_TRACE(azimuth);
      ViewSettings view = view_of(name, azimuth);
      view.elevation = elevation;
      const Camera camera = make_camera(view, box, box);
      const std::optional<ScaleBar> bar = scale_bar(camera, box, 800, 600);
      if (!bar) continue;  // its ground is cut by the picture's border
      ++bars;
      const auto drawn = [&](const std::string& label) {
        Image image(800, 600);
        std::fill(image.rgb.begin(), image.rgb.end(), std::uint8_t{255});
        draw_scale_bar(image, {bar->from, bar->to, bar->label_at, bar->length, label});
        return image;
      };
      const Image bare = drawn(""), labelled = drawn(bar->label);
      int letters = 0;
      for (int y = 1; y < 599; ++y)
        for (int x = 1; x < 799; ++x) {
          if (labelled.pixel(x, y)[0] == bare.pixel(x, y)[0]) continue;
          ++letters;
          for (int near_y : {y - 1, y, y + 1})
            for (int near_x : {x - 1, x, x + 1})
              EXPECT_EQ(bare.pixel(near_x, near_y)[0], 255) << x << " " << y << ": a letter touches the bar";
        }
      EXPECT_GT(letters, 100);
    }
  EXPECT_GT(bars, 50);
}

TEST(ScaleBar, HasItsWholeLabelInAPictureThatStands) {
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 15.0) {
    const Camera camera = make_camera(view_of(ViewName::overview, azimuth), box, box);
    const std::optional<ScaleBar> bar = scale_bar(camera, box, 500, 800);
    if (!bar) continue;
    const double cap = annotation_cap_height(800);
    EXPECT_GT(bar->label_at.x(), 0.0) << azimuth;
    EXPECT_LT(bar->label_at.x() + text_width(cap, bar->label), 500.0) << azimuth;
    EXPECT_LT(bar->label_at.y(), 800.0) << azimuth;
  }
}

}  // namespace
}  // namespace sandstroke
