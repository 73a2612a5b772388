#include "sweep/sweep_page.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/input_file.h"
#include "core/output_file.h"
#include "io/png_file.h"
#include "picture/shrunk.h"
#include "report/data_uri.h"
#include "sweep/collect.h"
#include "sweep/thumbnail.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

SweepManifest page_manifest() {
  SweepManifest m;
  m.scene = "strokes/wscg/scene.toml";
  m.design = {true,
              {{"relaxation.talus_angle", "deg", false, {"20", "22.5"}},
               {"model.preset", "", false, {"\"paper\"", "\"accurate\""}}}};
  m.metrics = {"max_force", "work"};
  m.version = "1";
  m.commit = "abc";
  return m;
}

class ASweepPage : public testing::Test {
 protected:
  SweepFolder make(const SweepManifest& m) { return SweepFolder::make(parent / "study", m); }
  static Json data_of(const SweepFolder& folder, CollectReport& report) {
    return sweep_page_data(CollectedSweep(folder, report), report);
  }
  static std::string uri(const Image& image) { return data_uri("image/png", encode_png(image)); }

  const TestFolder parent;
  CollectReport report;
};

TEST_F(ASweepPage, ShowsDesignPointsAndCounts) {
  const SweepFolder folder = make(page_manifest());
  folder.write(0, {PointVerdict::not_at_rest, "", {1.5, PointResult::none}}, "", {});
  folder.write(3, {PointVerdict::refused, "no <such> thing", {PointResult::none, PointResult::none}}, "", {});
  std::ofstream(folder.point_file(2)) << "cut off";
  const Json data = data_of(folder, report);
  EXPECT_EQ(data["title"], "study");
  EXPECT_EQ(data["scene"], "strokes/wscg/scene.toml");
  EXPECT_EQ(data["design"], "grid");
  EXPECT_TRUE(data["machine"].contains("cpu"));
  EXPECT_EQ(data["axes"], Json::parse(R"([
    {"name": "relaxation.talus_angle", "unit": "deg", "log": false, "numeric": true, "values": [20.0, 22.5]},
    {"name": "model.preset", "unit": "", "log": false, "numeric": false, "values": ["paper", "accurate"]}])"));
  ASSERT_EQ(data["metrics"].size(), 2u);
  EXPECT_EQ(data["metrics"][0]["name"], "max_force");
  for (const auto& shown : data["metrics"]) {
    const auto& metrics = all_metrics();
    const auto metric = std::find_if(metrics.begin(), metrics.end(),
                                     [&](const Metric& one) { return shown["name"] == one.name; });
    ASSERT_NE(metric, metrics.end());
    EXPECT_EQ(shown, Json({{"name", metric->name},
                           {"title", metric->title},
                           {"unit", metric->unit},
                           {"definition", metric->definition}}));
  }
  ASSERT_EQ(data["points"].size(), 4u);
  EXPECT_EQ(data["points"][0], Json({{"point", 0},
                                     {"at", {0, 0}},
                                     {"verdict", "not at rest"},
                                     {"reason", ""},
                                     {"metrics", {1.5, nullptr}},
                                     {"thumbnail", nullptr},
                                     {"command", folder.command(0)}}));
  EXPECT_EQ(data["points"][1]["verdict"], "missing");
  EXPECT_EQ(data["points"][2]["verdict"], "missing");
  EXPECT_NE(data["points"][2]["reason"], "");
  EXPECT_EQ(data["points"][3]["at"], Json({1, 1}));
  EXPECT_EQ(data["points"][3]["reason"], "no <such> thing");
  EXPECT_EQ(data["counts"], Json::parse(R"({"points": 4, "done": 1, "failed": 1, "missing": 2})"));
}

TEST_F(ASweepPage, HasAValueForEachPointOfALatinHypercube) {
  SweepManifest m = page_manifest();
  m.design = {false,
              {{"force.k_s", "N", true, {"1", "3", "2"}}, {"force.k_f", "s/m", false, {"7", "8", "9"}}}};
  const Json data = data_of(make(m), report);
  EXPECT_EQ(data["design"], "latin");
  EXPECT_EQ(data["axes"][0]["values"], Json({1.0, 3.0, 2.0}));
  EXPECT_EQ(data["axes"][0]["log"], true);
  EXPECT_EQ(data["points"][2]["at"], Json({2, 2}));
}

TEST_F(ASweepPage, ShowsThePictureThatWasKeptOrAMapOfTheSurface) {
  SweepManifest m = page_manifest();
  m.keep_picture = m.keep_surface = true;
  const SweepFolder folder = make(m);
  HeightField bed(40, 60, 0.1), higher = bed;
  bed.set(3, 4, -0.1);
  higher.set(3, 4, 0.3);
  Image picture(400, 300);
  std::fill(picture.rgb.begin(), picture.rgb.end(), std::uint8_t{99});
  write_png(folder.picture_file(0), picture);
  folder.write(0, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {&bed});
  folder.write(1, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {&higher});  // its picture is lost
  folder.write(2, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {&bed});
  std::ofstream(folder.picture_file(2)) << "no picture";
  const Json points = data_of(folder, report)["points"];
  EXPECT_EQ(points[0]["thumbnail"], uri(shrunk(picture, thumbnail_width)));
  // All are on one scale, which the highest of all points ends.
  EXPECT_EQ(points[1]["thumbnail"], uri(surface_thumbnail(folder.point_file(1), 0.3)));
  EXPECT_EQ(points[2]["thumbnail"], uri(surface_thumbnail(folder.point_file(2), 0.3)));
  EXPECT_EQ(points[3]["thumbnail"], nullptr);
  EXPECT_NE(report.sentences.back().find("2 pictures are missing"), std::string::npos)
      << report.sentences.back();
}

TEST_F(ASweepPage, ShowsLevelSandToo) {
  SweepManifest m = page_manifest();
  m.keep_surface = true;
  const SweepFolder folder = make(m);
  const HeightField level(10, 10, 0.1);
  folder.write(0, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {&level});
  EXPECT_EQ(data_of(folder, report)["points"][0]["thumbnail"],
            uri(surface_thumbnail(folder.point_file(0), 1.0)));
}

TEST_F(ASweepPage, HasNoPicturesOfVeryManyPointsAndSaysSo) {
  SweepManifest m = page_manifest();
  m.keep_surface = true;
  std::vector<std::string> values;
  for (std::size_t i = 0; i <= most_thumbnails; ++i) values.push_back(std::to_string(i));
  m.design = {true, {{"force.k_s", "N", false, values}}};
  const SweepFolder folder = make(m);
  const HeightField bed(10, 10, 0.1);
  folder.write(0, {PointVerdict::at_rest, "", {1.0, 2.0}}, "", {&bed});
  EXPECT_EQ(data_of(folder, report)["points"][0]["thumbnail"], nullptr);
  EXPECT_NE(report.sentences.back().find("no pictures"), std::string::npos);
}

TEST_F(ASweepPage, IsWrittenWithTheSweepsName) {
  const SweepFolder folder = make(page_manifest());
  collect(SweepFolder::open(parent.path() / "study" / "" / "."));
  const std::string page = read_text_file(parent / "study/sweep.html");
  EXPECT_NE(page.find("<title>Sweep study</title>"), std::string::npos);
  EXPECT_NE(page.find("relaxation.talus_angle"), std::string::npos);
}

}  // namespace
}  // namespace sandstroke
