#include "io/stroke_file.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>

#include "any_hdf5.h"
#include "core/error.h"
#include "core/output_file.h"
#include "hdf5/hdf5_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class StrokeFile : public testing::Test {
 protected:
  /// A stroke file with something spoilt or left out by `write`, after which its attributes are those given.
  fs::path file_with(const std::function<void(Hdf5Writer&)>& write) {
    const fs::path path = folder_ / "spoilt.h5";
    Hdf5Writer file(path, any_hdf5);
    write(file);
    file.finish();
    return path;
  }

  TestFolder folder_;
};

void write_good_columns(Hdf5Writer& file) {
  file.write("/stroke/time", std::vector<double>{0.0, 0.1, 0.2});
  file.write("/stroke/position", std::vector<Eigen::Vector3d>(3, Eigen::Vector3d::Ones()));
}

void write_attributes(Hdf5Writer& file) {
  file.attribute("/stroke", "format", std::string("sandstroke.stroke"));
  file.attribute("/stroke", "format_version", 1.0);
}

std::string complaint(const fs::path& path, ErrorKind kind = ErrorKind::input) {
  try {
    load_stroke(path, ForceSettings{});
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), kind);
    return failure.what();
  }
  return "";
}

Stroke full_stroke() {
  Stroke stroke;
  stroke.time = {0.1, 0.2 + 1e-17, 1.0 / 3.0};
  stroke.position = {{1e-300, -0.0, 0.1}, {1.0 / 7.0, 2e10, 3}, {4, 5, 6}};
  stroke.velocity = {{0.1, 0.2, 0.3}, {1, 2, 3}, {4, 5, 6}};
  stroke.force = {{-0.1, -0.2, -0.3}, {1, 2, 3}, {4, 5, 6}};
  stroke.orientation = {{0, 0, 0, 1}, {0.6, 0, 0, 0.8}, {-0.5, 0.5, -0.5, 0.5}};
  stroke.pressure = {0.0, 0.1, 1023.0};
  stroke.force_sign = ForceSign::by_hand;
  stroke.switches = {0, 3, 0xffffffffu};
  stroke.flags = {1, 0, 64};
  stroke.contact = {pen_up, pen_down, pen_lifts};
  stroke.nominal_rate = 999.9;
  stroke.gap_threshold = 0.07;
  stroke.source = "a hand, \"traced\"";
  stroke.frame = "device";
  stroke.complete = false;
  return stroke;
}

void expect_same(const Stroke& a, const Stroke& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.orientation, b.orientation);
  EXPECT_EQ(a.pressure, b.pressure);
  EXPECT_EQ(a.force_sign, b.force_sign);
  EXPECT_EQ(a.switches, b.switches);
  EXPECT_EQ(a.flags, b.flags);
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_EQ(a.nominal_rate, b.nominal_rate);
  EXPECT_EQ(a.gap_threshold, b.gap_threshold);
  EXPECT_EQ(a.source, b.source);
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.complete, b.complete);
}

TEST_F(StrokeFile, ComesBackToTheBit) {
  const fs::path path = folder_ / "full.h5";
  write_stroke_file(path, full_stroke());
  EXPECT_FALSE(fs::exists(part_path(path)));
  expect_same(read_stroke_file(path), full_stroke());
  expect_same(load_stroke(path, {}), full_stroke());
}

TEST_F(StrokeFile, KeepsThatHeightsCountFromTheSand) {
  Stroke stroke;
  stroke.time = {0.0};
  stroke.position = {Eigen::Vector3d::Zero()};
  for (const bool follows : {true, false}) {
    stroke.follows_sand = follows;
    const fs::path path = folder_ / (follows ? "sand.h5" : "bed.h5");
    write_stroke_file(path, stroke);
    EXPECT_EQ(read_stroke_file(path).follows_sand, follows);
  }
  const std::string from_the_bed = content_hash(stroke);
  stroke.follows_sand = true;
  EXPECT_NE(content_hash(stroke), from_the_bed);
}

TEST_F(StrokeFile, KeepsTheSpeedThatItsTimesWereMadeFor) {
  Stroke stroke;
  stroke.time = {0.0};
  stroke.position = {Eigen::Vector3d::Zero()};
  const std::string recorded = content_hash(stroke);
  stroke.tip_speed = 0.05;
  write_stroke_file(folder_ / "made.h5", stroke);
  EXPECT_EQ(read_stroke_file(folder_ / "made.h5").tip_speed, 0.05);
  EXPECT_NE(content_hash(stroke), recorded);
}

TEST_F(StrokeFile, ItsContentHashIsOfWhatARunTakesFromIt) {
  const Stroke stroke = full_stroke();
  const auto changes_it = [&](const std::function<void(Stroke&)>& change) {
    Stroke other = stroke;
    change(other);
    return content_hash(other) != content_hash(stroke);
  };
  EXPECT_FALSE(changes_it([](Stroke& s) { s.source = "elsewhere"; }));
  EXPECT_FALSE(changes_it([](Stroke& s) { s.velocity.clear(); }));
  EXPECT_TRUE(changes_it([](Stroke& s) { s.time[1] += 1e-12; }));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_TRUE(changes_it([axis](Stroke& s) { s.position.back()[axis] += 1e-12; })) << axis;
  EXPECT_TRUE(changes_it([](Stroke& s) { s.contact[0] = pen_down; }));
  EXPECT_TRUE(changes_it([](Stroke& s) { s.contact.clear(); }));
  EXPECT_TRUE(changes_it([](Stroke& s) { s.force[1].y() += 1e-12; }));
  EXPECT_TRUE(changes_it([](Stroke& s) { s.pressure[1] += 1e-12; }));
  EXPECT_TRUE(changes_it([](Stroke& s) { s.gap_threshold += 1e-12; }));
}

TEST_F(StrokeFile, OptionalColumnsMayBeAbsent) {
  Stroke stroke;
  stroke.time = {0.0};
  stroke.position = {{1, 2, 3}};
  write_stroke_file(folder_ / "bare.h5", stroke);
  expect_same(read_stroke_file(folder_ / "bare.h5"), stroke);
}

TEST_F(StrokeFile, OnlyFormatAndVersionAreRequired) {
  const Stroke stroke = read_stroke_file(file_with([](Hdf5Writer& file) {
    write_good_columns(file);
    write_attributes(file);
  }));
  EXPECT_EQ(stroke.size(), 3u);
  EXPECT_EQ(stroke.frame, "bed");
  EXPECT_DOUBLE_EQ(stroke.gap_threshold, 0.5);  // five times the usual spacing
  EXPECT_TRUE(stroke.complete);
}

TEST_F(StrokeFile, AnUnsoundStrokeIsNotWritten) {
  Stroke stroke = full_stroke();
  stroke.time[2] = 0.0;
  EXPECT_THROW(write_stroke_file(folder_ / "bad.h5", stroke), Error);
  EXPECT_FALSE(fs::exists(folder_ / "bad.h5"));
  EXPECT_FALSE(fs::exists(part_path(folder_ / "bad.h5")));
}

TEST_F(StrokeFile, SaysWhatIsWrongInAFile) {
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) { write_good_columns(file); })),
              AllOf(HasSubstr("spoilt.h5"), HasSubstr("/stroke"), HasSubstr("sandstroke.stroke")));
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) { file.write("/other", std::vector<double>{1}); })),
              HasSubstr("is not a stroke file"));
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) {
                write_good_columns(file);
                file.attribute("/stroke", "format", std::string("sandstroke.stroke"));
                file.attribute("/stroke", "format_version", 2.0);
              })),
              HasSubstr("format_version 2"));
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) {
                file.write("/stroke/time", std::vector<double>{0.0});
                write_attributes(file);
              })),
              HasSubstr("/stroke/position"));
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) {
                write_good_columns(file);
                file.write("/stroke/force", std::vector<Eigen::Vector3d>(2, Eigen::Vector3d::Ones()));
                write_attributes(file);
              })),
              AllOf(HasSubstr("spoilt.h5: /stroke"), HasSubstr("force has 2 rows")));
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) {
                file.write("/stroke/time", std::vector<double>{0.0, 0.2, 0.1});
                file.write("/stroke/position", std::vector<Eigen::Vector3d>(3, Eigen::Vector3d::Ones()));
                write_attributes(file);
              })),
              AllOf(HasSubstr("time of sample 2"), HasSubstr("0.1")));
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) {
                const double nan = std::numeric_limits<double>::quiet_NaN();
                file.write("/stroke/time", std::vector<double>{0.0});
                file.write("/stroke/position", std::vector<Eigen::Vector3d>{{0, nan, 0}});
                write_attributes(file);
              })),
              AllOf(HasSubstr("position of sample 0"), HasSubstr("nan")));
  EXPECT_THAT(complaint(file_with([](Hdf5Writer& file) {
                write_good_columns(file);
                file.write("/stroke/contact", std::vector<std::uint32_t>{1, 257, 1});
                write_attributes(file);
              })),
              AllOf(HasSubstr("contact of sample 1"), HasSubstr("257")));
}

TEST_F(StrokeFile, LoadsByContentOrExtension) {
  const fs::path unnamed = folder_ / "recorded";
  write_stroke_file(unnamed, full_stroke());
  expect_same(load_stroke(unnamed, {}), full_stroke());

  const fs::path script = folder_ / "script.toml";
  put_text(script, "force = 2.0\nplunge_speed = 50\n[[segment]]\nkind = \"line\"\nto = [0.1, 0]\n");
  ForceSettings settings;
  settings.k_s = 300.0;
  const Stroke stroke = load_stroke(script, settings);
  EXPECT_NEAR(repulse_force(-stroke.position[stroke.size() / 2].z(), settings), 2.0, 1e-12);

  const fs::path table = folder_ / "table.csv";
  put_text(table, "x,y,z\n1,2,3\n4,5,6\n");
  EXPECT_THAT(complaint(table), AllOf(HasSubstr("table.csv"), HasSubstr("stroke.table.position_unit")));
  TableSettings of_table;
  of_table.position_unit = "m";
  of_table.rate = 10.0;
  EXPECT_EQ(load_stroke(table, {}, of_table).position[1], Eigen::Vector3d(4, 5, 6));
  const fs::path journal = folder_ / "cut.h5.recording";
  put_text(journal, "sandstroke.recording");
  EXPECT_THAT(complaint(journal), HasSubstr("sandstroke stroke repair " + journal.string()));
  const fs::path text = folder_ / "text.h5";
  put_text(text, "no HDF5");
  EXPECT_THAT(complaint(text), AllOf(HasSubstr("text.h5"), HasSubstr("HDF5")));
  EXPECT_THAT(complaint(folder_ / "absent.h5", ErrorKind::io), HasSubstr("absent.h5"));
  EXPECT_THAT(complaint(folder_.path(), ErrorKind::io), HasSubstr("folder"));
}

}  // namespace
}  // namespace sandstroke
