#include "import/import_stroke.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "core/output_file.h"
#include "haptics/stroke_placement.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// t,x,y,z with a header row; s and m.
TableSettings txyz() {
  TableSettings table;
  table.position_unit = "m";
  table.time_unit = "s";
  return table;
}

/// x,y,t without a header row; pen strokes parted by BREAK.
TableSettings drawing() {
  TableSettings table;
  table.columns = "x,y,t";
  table.position = "x,y";
  table.position_unit = "m";
  table.time_unit = "ms";
  table.skip = "START";
  table.pen_up = "BREAK";
  return table;
}

Stroke parse(const std::string& text, const TableSettings& table) {
  return import_stroke_text(text, "in.csv", table).stroke;
}

std::string complaint(const std::string& text, const TableSettings& format) {
  try {
    parse(text, format);
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

TEST(TextTable, ReadsNamedColumnsInAnyOrder) {
  TableSettings format = txyz();
  format.force_unit = "mN";
  format.velocity = "vx,vy";
  format.velocity_unit = "cm/s";
  const Stroke stroke = parse(
      "z,note,t,x,y,fx,fy,fz,vx,vy\n3,9,0.5,1,2,100,200,-300,10,20\n6,9,0.75,4,+5,0,0,1e3,0,0\n", format);
  EXPECT_THAT(stroke.time, ElementsAre(0.5, 0.75));
  EXPECT_THAT(stroke.position, ElementsAre(Vector3d(1, 2, 3), Vector3d(4, 5, 6)));
  EXPECT_THAT(stroke.force, ElementsAre(Vector3d(0.1, 0.2, -0.3), Vector3d(0, 0, 1)));
  EXPECT_THAT(stroke.velocity, ElementsAre(Vector3d(0.1, 0.2, 0), Vector3d(0, 0, 0)));
  EXPECT_TRUE(stroke.contact.empty());
  EXPECT_EQ(stroke.nominal_rate, 0.0);
}

TEST(TextTable, AnEvenRateStandsForTheTimes) {
  TableSettings format = txyz();
  format.time_unit.clear();
  format.rate = 1000.0;
  const Stroke stroke = parse("x,y,z\n1,0,0\n2,0,0\n3,0,0\n", format);
  EXPECT_THAT(stroke.time, ElementsAre(0.0, 0.001, 0.002));
  EXPECT_EQ(stroke.nominal_rate, 1000.0);
}

TEST(TextTable, ToleratesWhatEditorsDo) {
  const std::string text =
      "\xEF\xBB\xBF t , x ,y,z\r\n\r\n0, 1 ,\t2,3\r\n   \r\n1,4,5,6";  // no newline at the end
  const Stroke stroke = parse(text, txyz());
  EXPECT_THAT(stroke.position, ElementsAre(Vector3d(1, 2, 3), Vector3d(4, 5, 6)));
}

TEST(TextTable, PenStrokesAreKeptApart) {
  const Stroke stroke =
      parse("START\n1,2,0\n2,2,10\nBREAK\n5,5,20\nBREAK\n7,7,30\n8,8,40\nBREAK\n", drawing());
  EXPECT_THAT(stroke.contact, ElementsAre(pen_down, pen_lifts, pen_lifts, pen_down, pen_lifts));
  EXPECT_EQ(stroke.position[0], Vector3d(1, 2, 0));
  const std::vector<bool> joined = {true, false, false, true, false};
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    EXPECT_EQ(stroke.joined(i), joined[i]) << i;
    EXPECT_TRUE(stroke.pen_down(i));  // a single sample is a point that was drawn
  }
}

TEST(TextTable, EqualTimesAreAnErrorUnlessAsked) {
  const std::string text = "START\n0,0,0\n1,0,10\n2,0,10\n3,0,10\n4,0,40\n";
  TableSettings format = drawing();
  EXPECT_THAT(complaint(text, format),
              AllOf(HasSubstr("in.csv:4:"), HasSubstr("line 3"), HasSubstr("--equal-times")));

  format.equal_times = EqualTimes::drop;
  const Stroke dropped = parse(text, format);
  EXPECT_THAT(dropped.time, ElementsAre(0.0, 0.01, 0.04));
  EXPECT_THAT(dropped.position, ElementsAre(Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(4, 0, 0)));

  format.equal_times = EqualTimes::spread;
  const Stroke spread = parse(text, format);
  EXPECT_EQ(spread.size(), 5u);
  EXPECT_DOUBLE_EQ(spread.time[1], 0.01);
  EXPECT_DOUBLE_EQ(spread.time[2], 0.02);
  EXPECT_DOUBLE_EQ(spread.time[3], 0.03);
  EXPECT_EQ(spread.time[4], 0.04);
}

TEST(TextTable, TheLastEqualTimesAreSpacedAsBefore) {
  TableSettings format = drawing();
  format.equal_times = EqualTimes::spread;
  const Stroke stroke = parse("0,0,0\n1,0,10\n2,0,15\n3,0,15\n4,0,15\n", format);
  EXPECT_DOUBLE_EQ(stroke.time[3], 0.020);
  EXPECT_DOUBLE_EQ(stroke.time[4], 0.025);
}

TEST(TextTable, EqualTimesDoNotStretchIntoThePauseBetweenPenStrokes) {
  TableSettings format = drawing();
  format.equal_times = EqualTimes::spread;
  const Stroke stroke = parse("0,0,0\n1,0,10\n2,0,10\nBREAK\n3,0,1000\n", format);
  EXPECT_DOUBLE_EQ(stroke.time[2], 0.020);  // not 0.505
  const Stroke close = parse("0,0,0\n1,0,10\n2,0,10\nBREAK\n3,0,14\n", format);
  EXPECT_DOUBLE_EQ(close.time[2], 0.012);  // but before the next
}

TEST(TextTable, DroppedSamplesLeaveTheLift) {
  TableSettings format = drawing();
  format.equal_times = EqualTimes::drop;
  const Stroke stroke = parse("0,0,0\n1,0,10\n1,0,10\nBREAK\n3,0,20\n4,0,30\n", format);
  EXPECT_THAT(stroke.time, ElementsAre(0.0, 0.01, 0.02, 0.03));
  EXPECT_THAT(stroke.contact, ElementsAre(pen_down, pen_lifts, pen_down, pen_down));
}

TEST(TextTable, KeepsTheFirstSampleOfEqualTimesWhole) {
  // The first sample of each run stays, with its own velocity and force, not the next one's.
  TableSettings format = txyz();
  format.velocity_unit = "m/s";
  format.force_unit = "N";
  format.equal_times = EqualTimes::drop;
  const std::string header = "t,x,y,z,vx,vy,fx,fy\n";
  const auto rows = [&](const std::vector<double>& times) {
    std::string text = header;
    for (std::size_t i = 0; i < times.size(); ++i) {
      const auto n = [i](int column) { return std::to_string(10 * i + static_cast<std::size_t>(column)); };
      text += std::to_string(times[i]) + "," + n(1) + "," + n(2) + "," + n(3) + "," + n(4) + "," + n(5) +
              "," + n(6) + "," + n(7) + "\n";
    }
    return text;
  };
  struct Case {
    std::vector<double> times;
    std::vector<int> kept;
  };
  for (const Case& one : {Case{{0, 1, 2}, {0, 1, 2}},
                          {{0, 0, 1, 2}, {0, 2, 3}},
                          {{0, 1, 1, 1, 2}, {0, 1, 4}},
                          {{0, 1, 2, 2, 2}, {0, 1, 2}},
                          {{0, 0, 1, 1, 2, 2}, {0, 2, 4}},
                          {{3, 3, 3}, {0}}}) {
    const Stroke stroke = parse(rows(one.times), format);
    ASSERT_EQ(stroke.size(), one.kept.size());
    ASSERT_EQ(stroke.velocity.size(), one.kept.size());
    ASSERT_EQ(stroke.force.size(), one.kept.size());
    for (std::size_t k = 0; k < one.kept.size(); ++k) {
      const int i = 10 * one.kept[k];
      EXPECT_EQ(stroke.time[k], one.times[static_cast<std::size_t>(one.kept[k])]);
      EXPECT_EQ(stroke.position[k], Vector3d(i + 1, i + 2, i + 3));
      EXPECT_EQ(stroke.velocity[k], Vector3d(i + 4, i + 5, 0));
      EXPECT_EQ(stroke.force[k], Vector3d(i + 6, i + 7, 0));
    }
  }
}

TEST(TextTable, DecreasingTimeIsAlwaysAnError) {
  for (const EqualTimes equal : {EqualTimes::error, EqualTimes::drop, EqualTimes::spread}) {
    TableSettings format = drawing();
    format.equal_times = equal;
    EXPECT_THAT(complaint("START\n0,0,5\nBREAK\n1,0,4\n", format),
                AllOf(HasSubstr("in.csv:4:"), HasSubstr("line 2")));
  }
}

TEST(TextTable, SaysWhichLineIsBad) {
  const TableSettings format = txyz();
  const std::string header = "t,x,y,z\n0,0,0,0\n";
  EXPECT_THAT(complaint("", format), AllOf(HasSubstr("in.csv"), HasSubstr("empty")));
  EXPECT_THAT(complaint("\r\n \n", format), HasSubstr("empty"));
  EXPECT_THAT(complaint("t,x,y,z\n", format), AllOf(HasSubstr("in.csv"), HasSubstr("has no samples")));
  TableSettings other = txyz();
  other.position = "x,y,z";
  EXPECT_THAT(complaint("t,x,y\n0,0,0\n", other),
              AllOf(HasSubstr("in.csv:1:"), HasSubstr("column 'z' is missing"), HasSubstr("t, x, y")));
  EXPECT_THAT(complaint("t,x,y,z,x\n1,2,3,4,5\n", format),
              AllOf(HasSubstr("in.csv:1:"), HasSubstr("2 columns"), HasSubstr("'x'")));
  EXPECT_THAT(complaint(header + "1,2,3\n", format),
              AllOf(HasSubstr("in.csv:3:"), HasSubstr("3 fields instead of 4 ")));
  EXPECT_THAT(complaint(header + "1,2,3,4,5\n", format), HasSubstr("in.csv:3: 5 fields instead of 4 "));
  for (const std::string bad : {"inf", "-inf", "abc", "1.5mm", "1e999", "0x10", "1 2", "--1"})
    EXPECT_THAT(complaint(header + "\n1,2,3," + bad + "\n", format),
                AllOf(HasSubstr("in.csv:4:"), HasSubstr("'" + bad + "'")))
        << bad;

  TableSettings headless = drawing();
  headless.position = "x,w";
  EXPECT_THAT(complaint("1,2,3\n", headless), AllOf(HasSubstr("--columns"), HasSubstr("'w'")));
  TableSettings spread = drawing();
  spread.equal_times = EqualTimes::spread;
  EXPECT_THAT(complaint("1,2,3\n2,3,3\n", spread), AllOf(HasSubstr("same time"), HasSubstr("--rate")));
}

TEST(TextTable, ReadsARecordingOfARobotArm) {
  const fs::path file = fs::path(SANDSTROKE_SHARED_DATA) / "panda_comanip_force_1khz" / "symbol17_rec2.csv";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there";
  TableSettings format;
  format.rate = 1000.0;  // all else its header says: x_m, vx_mps, fx_N
  const Stroke stroke = import_stroke(file, format).stroke;
  EXPECT_EQ(stroke.velocity.size(), stroke.size());
  ASSERT_EQ(stroke.size(), 8647u);
  EXPECT_EQ(stroke.position[0], Vector3d(-0.5070279, -0.2422634, 0.2589536));
  EXPECT_EQ(stroke.force[1], Vector3d(0.1831, -0.3048, -1.9535));
  EXPECT_NEAR(stroke.duration(), 8.646, 1e-12);

  // It was traced on a sheet of paper: laid level, it is flat to about a millimetre over 0.15 m.
  StrokePlacement placement;
  placement.plane = StrokePlane::fit;
  for (const Vector3d& p : place_stroke(stroke, placement).position) EXPECT_LT(std::abs(p.z()), 1e-3);
}

TEST(TextTable, ReadsLettersDrawnOnAScreen) {
  const fs::path folder = fs::path(SANDSTROKE_SHARED_DATA) / "omniglot_timed_strokes" / "Greek";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  TableSettings format = drawing();
  format.position_unit = "px";
  format.pixel_size = 0.002;
  int drawings = 0, pen_strokes = 0;
  std::size_t points = 0, left = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".txt") continue;
    ++drawings;
    format.equal_times = EqualTimes::spread;
    const Stroke stroke = import_stroke(entry.path(), format).stroke;
    points += stroke.size();
    for (const std::uint8_t state : stroke.contact) pen_strokes += state == pen_lifts;
    format.equal_times = EqualTimes::drop;
    left += import_stroke(entry.path(), format).stroke.size();
  }
  EXPECT_EQ(drawings, 120);
  EXPECT_EQ(pen_strokes, 184);
  EXPECT_EQ(points, 13924u);
  // 2.2 % of the steps from point to point have equal stamps.
  EXPECT_NEAR(static_cast<double>(points - left) / static_cast<double>(points - 184), 0.022, 0.0005);
}

TEST(TextTable, ADroppedSampleIsDroppedFromEveryColumn) {
  TableSettings format = txyz();
  format.velocity_unit = "m/s";
  format.force_unit = "N";
  format.pen_up = "BREAK";
  format.equal_times = EqualTimes::drop;
  const Stroke stroke = parse(
      "t,x,y,z,vx,vy,vz,fx,fy,fz\n"
      "0,1,2,3,4,5,6,7,8,9\n0,11,12,13,14,15,16,17,18,19\n"
      "1,21,22,23,24,25,26,27,28,29\nBREAK\n1,31,32,33,34,35,36,37,38,39\n3,41,42,43,44,45,46,47,48,49\n",
      format);
  EXPECT_THAT(stroke.time, ElementsAre(0.0, 1.0, 3.0));
  EXPECT_THAT(stroke.position, ElementsAre(Vector3d(1, 2, 3), Vector3d(21, 22, 23), Vector3d(41, 42, 43)));
  EXPECT_THAT(stroke.velocity, ElementsAre(Vector3d(4, 5, 6), Vector3d(24, 25, 26), Vector3d(44, 45, 46)));
  EXPECT_THAT(stroke.force, ElementsAre(Vector3d(7, 8, 9), Vector3d(27, 28, 29), Vector3d(47, 48, 49)));
  EXPECT_THAT(stroke.contact, ElementsAre(pen_down, pen_lifts, pen_down));
}

TEST(TextTable, EachQuantityHasItsOwnUnit) {
  TableSettings format = txyz();
  format.time_unit = "ms";
  format.position_unit = "mm";
  format.velocity_unit = "cm/s";
  format.force_unit = "mN";
  const Stroke stroke = parse("t,x,y,z,vx,vy,vz,fx,fy,fz\n50,1,2,3,100,200,300,7,8,9\n", format);
  EXPECT_EQ(stroke.time[0], 0.05);
  EXPECT_EQ(stroke.position[0], Vector3d(0.001, 0.002, 0.003));
  EXPECT_EQ(stroke.velocity[0], Vector3d(1, 2, 3));
  EXPECT_EQ(stroke.force[0], Vector3d(0.007, 0.008, 0.009));
}

TEST(TextTable, AFileIsReadInPartsWhereverTheyAreCut) {
  const TestFolder folder;
  std::string text = "\xEF\xBB\xBFt,x,y,z\r\n";
  for (int i = 0; text.size() < 200'000; ++i) text += fmt::format("{},{},0.25,-1\r\n", i, i % 977);
  text += "1e6,0,0,0";  // without an end of its line
  write_text_file(folder / "table.csv", text);
  const Stroke read = import_stroke(folder / "table.csv", txyz()).stroke, parsed = parse(text, txyz());
  EXPECT_EQ(read.time, parsed.time);
  EXPECT_EQ(read.position, parsed.position);
  EXPECT_EQ(read.time.back(), 1e6);
}

TEST(TextTable, ALineThatDoesNotEndIsRefused) {
  const std::string text = "t,x,y,z\n0,0,0,0\n1" + std::string(1'000'000, ' ');
  EXPECT_EQ(complaint(text, txyz()), "in.csv:3: the line is longer than 1 MB; write one sample per line");
  EXPECT_EQ(parse(text.substr(0, text.size() - 7) + ",1,1,1", txyz()).size(), 2u);
}

TEST(TextTable, WhatTheDiskDoesNotGiveIsAnError) {
  try {
    import_stroke("/proc/self/mem", txyz());  // at address 0 there is nothing: reading it is an EIO
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_THAT(error.what(), HasSubstr("cannot be read (Input/output error)"));
  }
}

}  // namespace
}  // namespace sandstroke
