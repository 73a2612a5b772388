#include "sim/check_sources.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>

#include "core/error.h"

namespace sandstroke {
namespace {

/// A scene without a stroke whose second source is good, but for what the caller changes.
Scene scene_with_sources() {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.2;
  scene.bed.cols = scene.bed.rows = 40;
  for (SourceSettings& source : scene.sources = std::vector<SourceSettings>(2)) {
    source.at.z() = 0.1;
    source.rate = 0.01;
    source.stop = 1.0;
  }
  return scene;
}

/// What is said of a scene after a change of its second source.
std::string said_of(const std::function<void(Scene&, SourceSettings&)>& change) {
  Scene scene = scene_with_sources();
  change(scene, scene.sources[1]);
  try {
    check_sources(scene, "scene.toml");
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

TEST(CheckSources, SaysWhatIsWrongWithWhichSource) {
  EXPECT_EQ(said_of([](Scene&, SourceSettings&) {}), "");
  EXPECT_EQ(
      said_of([](Scene&, SourceSettings& s) { s.rate = 0.0; }),
      "scene.toml: source.2.rate = 0: it neither pours nor takes sand; set a rate in kg/s, or remove the "
      "[[source]]");
  EXPECT_EQ(said_of([](Scene&, SourceSettings& s) { s.start = 1.0; }),
            "scene.toml: source.2.stop = 1 s is not after its start = 1 s; set a later stop");
  const auto never_stops = [](Scene&, SourceSettings& s) {
    s.stop = std::numeric_limits<double>::infinity();
  };
  EXPECT_EQ(said_of(never_stops),
            "scene.toml: source.2.stop is missing, and no [stroke] ends the run; set the time in seconds at "
            "which it stops");
  EXPECT_EQ(said_of([&](Scene& scene, SourceSettings& s) {
              never_stops(scene, s);
              scene.stroke.emplace();
            }),
            "");
  EXPECT_EQ(
      said_of([](Scene&, SourceSettings& s) { s.at.y() = -0.103; }),
      "scene.toml: source.2.at is 3 mm beyond the bed's edge, at x = 0 m, y = -0.103 m; move it over the "
      "bed, or enlarge bed.size");
  EXPECT_NE(said_of([](Scene& scene, SourceSettings& s) {
              scene.bed.shape = BedShape::round;
              s.at = {0.08, 0.08, 0.1};
            }).find("source.2.at is 13.14 mm beyond"),
            std::string::npos);
  EXPECT_NE(said_of([](Scene&, SourceSettings& s) { s.at.z() = 1e30; }).find("the sand in the air"),
            std::string::npos);
}

TEST(CheckSources, LooksAtThePathWhereItIsDown) {
  Stroke path;
  path.time = {0.0, 0.1, 0.2};
  path.position = {{0.0, 0.0, 0.1}, {0.05, 0.0, 0.1}, {0.15, 0.0, 0.1}};
  path.contact = {pen_down, pen_lifts, pen_up};
  const auto along = [&](Scene&, SourceSettings& s) {
    s.path = "path.toml";
    s.stroke = std::make_shared<const Stroke>(path);
  };
  EXPECT_EQ(said_of(along), "");
  path.contact.clear();
  EXPECT_NE(said_of(along).find("source.2.path: sample 2 is 50 mm beyond the bed's edge"), std::string::npos);
  path.follows_sand = true;
  EXPECT_NE(said_of(along).find("its heights count from the sand"), std::string::npos);
}

}  // namespace
}  // namespace sandstroke
