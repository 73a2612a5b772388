#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <bit>

#include "core/error.h"
#include "import/import_stroke.h"
#include "import/units.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

ImportedStroke import_text(const std::string& text, const TableSettings& settings = {}) {
  return import_stroke_text(text, "in.csv", settings);
}

std::string refusal(const std::string& text, const TableSettings& settings = {}) {
  try {
    import_text(text, settings);
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

enum class ByteMark { none, first };

/// ASCII as UTF-16.
std::string utf16(const std::string& text, std::endian order, ByteMark byte_mark) {
  const bool big_endian = order == std::endian::big, mark = byte_mark == ByteMark::first;
  std::string bytes = !mark ? "" : big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return bytes;
}

/// Time in ms, position in mm: (1.5, -2, 0.25), then (1.75, 3, 0.5).
const std::vector<Vector3d> two_positions{{0.0015, -0.002, 0.00025}, {0.00175, 0.003, 0.0005}};

struct Dialected {
  const char* seen;
  std::string text;
};

class Dialects : public testing::TestWithParam<Dialected> {};

TEST_P(Dialects, SayTheSame) {
  const ImportedStroke imported = import_text(GetParam().text);
  EXPECT_THAT(imported.stroke.time, ElementsAre(0.0, 0.01));
  EXPECT_EQ(imported.stroke.position, two_positions);
  EXPECT_THAT(imported.description, StartsWith(GetParam().seen));
}

INSTANTIATE_TEST_SUITE_P(
    Tables, Dialects,
    testing::Values(
        Dialected{"commas, decimal points, 4 columns, 2 rows",
                  "t_ms,x_mm,y_mm,z_mm\n0,1.5,-2,0.25\n10,1.75,3,0.5\n"},
        Dialected{"semicolons, decimal commas, 4 columns",
                  "t [ms];x [mm];y [mm];z [mm]\r\n0;1,5;-2;0,25\r\n10;1,75;3;0,5\r\n"},
        Dialected{"semicolons, decimal points",
                  "t [ms];x [mm];y [mm];z [mm]\n0;1.5;-2;0.25\n10;1.75;3;0.5\n"},
        Dialected{"tabs, decimal points",
                  "time (ms)\tX (mm)\tY (mm)\tZ (mm)\n0\t1.5\t-2\t0.25\n10\t1.75\t3\t0.5\n"},
        Dialected{"tabs, decimal commas", "t_ms\tx_mm\ty_mm\tz_mm\n0\t1,5\t-2\t0,25\n10\t1,75\t3\t0,5\n"},
        Dialected{"spaces, decimal points", "t_ms  x_mm y_mm   z_mm\n 0  1.5 -2 0.25\n10 1.75  3 0.5  \n"},
        Dialected{"spaces, decimal commas", "t_ms x_mm y_mm z_mm\n0 1,5 -2 0,25\n10 1,75 3 0,5\n"},
        Dialected{"commas, decimal commas",
                  "\"t_ms\",\"x_mm\",y_mm,z_mm\n0,\"1,5\",-2,\"0,25\"\n10,\"1,75\",3,\"0,5\"\n"},
        // numpy.savetxt(header="...")
        Dialected{"spaces, decimal points", "# t_ms x_mm y_mm z_mm\n0 1.5e+00 -2 2.5e-01\n10 1.75 3 5e-1\n"},
        Dialected{"commas, decimal points",
                  "# of a robot\n#t_ms,x_mm,y_mm,z_mm\n0,1.5,-2,0.25\n# late\n10,1.75,3,0.5\n"},
        // R's write.table: its header lacks the names of rows
        Dialected{"spaces, decimal points, 5 columns",
                  "\"t_ms\" \"x_mm\" \"y_mm\" \"z_mm\"\n\"1\" 0 1.5 -2 0.25\n\"2\" 10 1.75 3 0.5\n"},
        Dialected{"commas, decimal points, 5 columns",
                  "\"\",\"t_ms\",\"x_mm\",\"y_mm\",\"z_mm\"\n\"1\",0,1.5,-2,0.25\n\"2\",10,1.75,3,0.5\n"},
        // Excel
        Dialected{"semicolons, decimal commas",
                  "sep=;\r\nt_ms;x_mm;y_mm;z_mm\r\n0;1,5;-2;0,25\r\n10;1,75;3;0,5\r\n"},
        Dialected{"semicolons", "\xEF\xBB\xBFt_ms;x_mm;y_mm;z_mm\n0;1,5;-2;0,25\n10;1,75;3;0,5\n"},
        Dialected{"UTF-16LE, tabs",
                  utf16("t_ms\tx_mm\ty_mm\tz_mm\r\n0\t1.5\t-2\t0.25\r\n10\t1.75\t3\t0.5\r\n",
                        std::endian::little, ByteMark::first)},
        Dialected{"UTF-16BE, commas", utf16("t_ms,x_mm,y_mm,z_mm\n0,1.5,-2,0.25\n10,1.75,3,0.5",
                                            std::endian::big, ByteMark::first)},
        Dialected{"UTF-16LE, commas", utf16("t_ms,x_mm,y_mm,z_mm\n0,1.5,-2,0.25\n10,1.75,3,0.5",
                                            std::endian::little, ByteMark::none)},
        // a row of units; other columns with text
        Dialected{"commas, decimal points, 5 columns",
                  "note,time,pos.x,pos.y,pos.z\n,ms,mm,mm,mm\na,0,1.5,-2,0.25\nb,10,1.75,3,0.5\n"},
        Dialected{"commas",
                  "tip_posX [mm],t_ms,tip_posY [mm],tip_posZ [mm],\n1.5,0,-2,0.25,\n1.75,10,3,0.5,\n"}));

TEST(Dialect, WhatIsNamedIsNotLookedFor) {
  TableSettings settings;
  settings.rate = 100.0;
  settings.position_unit = "m";
  EXPECT_EQ(import_text("x,y\n1,2\n", settings).stroke.position[0], Vector3d(1, 2, 0));
  settings.separator = Separator::blanks;
  settings.decimal = DecimalMark::comma;
  EXPECT_EQ(import_text("x y\n1,2 3,4\n", settings).stroke.position[0], Vector3d(1.2, 3.4, 0));
  settings.separator = Separator::semicolon;
  EXPECT_THAT(refusal("x y\n1,2 3,4\n", settings),
              HasSubstr("in.csv:2: '1,2 3,4' is not a row of two or more numbers"));
  settings = {};
  settings.encoding = "ISO-8859-1";
  settings.rate = 1.0;
  settings.position_unit = "mm";
  EXPECT_EQ(import_text("x;y;\xB5\n1;2;3\n", settings).stroke.position[0], Vector3d(0.001, 0.002, 0));
  settings.encoding = "EBCDIC-of-mine";
  EXPECT_THAT(refusal("x,y\n1,2\n", settings), HasSubstr("'EBCDIC-of-mine' is not a known encoding"));
}

TEST(Dialect, ColumnsWithoutNamesHaveNumbers) {
  TableSettings settings;
  EXPECT_THAT(refusal("0\t1\t2\t3\n1\t1\t2\t4\n"),
              AllOf(HasSubstr("in.csv:1 (no header"),
                    HasSubstr("stroke.table.position (stroke convert: --position)")));
  settings.position = "2,3,4";
  settings.time = "1";
  EXPECT_THAT(refusal("0\t1\t2\t3\n", settings),
              HasSubstr("stroke.table.position_unit (stroke convert: --position-unit)"));
  settings.position_unit = "cm";
  EXPECT_THAT(refusal("0\t1\t2\t3\n", settings),
              HasSubstr("stroke.table.time_unit (stroke convert: --time-unit)"));
  settings.time_unit = "us";
  const ImportedStroke imported = import_text("0\t1\t2\t3\n50\t1\t2\t4\n", settings);
  EXPECT_THAT(imported.stroke.time, ElementsAre(0.0, 0.00005));
  EXPECT_EQ(imported.stroke.position[1], Vector3d(0.01, 0.02, 0.04));
  EXPECT_THAT(imported.description, HasSubstr("tabs, decimal points, 4 columns, 2 rows, no header"));
  settings.position = "2,3,9";
  EXPECT_THAT(refusal("0\t1\t2\t3\n", settings),
              HasSubstr("column '9' is missing; the columns are: 1, 2, 3, 4"));
}

TEST(Dialect, LinesWithOneOfSeveralWordsAreSkipped) {
  TableSettings settings;
  settings.skip = "START,Robot:,-";
  settings.pen_up = "BREAK,UP";
  settings.skip_lines = 2;
  settings.rate = 10.0;
  settings.position_unit = "m";
  const Stroke stroke =
      import_text("a; b\n;;;\nRobot: UR5\nSTART\nx,y\n- - -\n-1,2\nBREAK now\n3,4\n4,4\nUP\n", settings)
          .stroke;
  EXPECT_THAT(stroke.position, ElementsAre(Vector3d(-1, 2, 0), Vector3d(3, 4, 0), Vector3d(4, 4, 0)));
  EXPECT_THAT(stroke.contact, ElementsAre(pen_lifts, pen_down, pen_lifts));
  EXPECT_THAT(import_text("a\nb\nx,y\n1,2\n3,4\n", settings).warnings,
              ElementsAre(HasSubstr("no line begins with BREAK,UP, so the pen never lifts")));
  EXPECT_THAT(refusal("x,y\n1,2\nSTARTED\n", settings), HasSubstr("no samples"));  // two were passed over
  settings.skip_lines = 0;
  EXPECT_THAT(refusal("x,y\n1,2\nSTARTED\n", settings), HasSubstr("in.csv:3: 1 fields instead of 2"));
}

TEST(Dialect, WhatIsNoTableIsSaidWithItsLine) {
  EXPECT_THAT(refusal("Dear all,\nthis is no table\nbut a letter\n"),
              AllOf(HasSubstr("in.csv:2: 'this is no table' is not a row"), HasSubstr("--skip")));
  EXPECT_THAT(refusal("Robot: UR5\nx_m;y_m\n1;2\n3;4\n"),
              AllOf(HasSubstr("in.csv:1: the first line has 1 fields (Robot: UR5), but most lines have 2"),
                    HasSubstr("--skip-lines")));
  EXPECT_THAT(refusal("3\nx_m;y_m\n1;2\n3;4\n"), HasSubstr("--skip-lines"));
  EXPECT_THAT(refusal("x,y,z\n"), HasSubstr("no samples"));
  EXPECT_THAT(refusal("x,y\n1,2\n"), HasSubstr("unit of x, y is not known"));
  EXPECT_THAT(refusal("x_m,y_m\n1,2\n"),
              AllOf(HasSubstr("--time)"), HasSubstr("--rate)"), HasSubstr("--speed)")));
  EXPECT_THAT(refusal("a_x,a_y,u_x,u_y,b_x,b_y\n1,2,3,4,5,6\n"), HasSubstr("'b_x' and 'u_x' may both be"));
  EXPECT_THAT(refusal(std::string("x,y\n1,2\0\n", 9)), HasSubstr("in.csv:2: contains a zero byte"));
  EXPECT_THAT(refusal("\xFF\xFEx"), HasSubstr("ends in the middle of a character"));
  TableSettings settings;
  settings.encoding = "ASCII";
  EXPECT_THAT(refusal("x,\xE4\n1,2\n", settings), HasSubstr("is not text in ASCII"));
}

TEST(Dialect, LinesMayEndAsOnOldMacs) {
  TableSettings settings;
  settings.rate = 10.0;
  for (const char* text : {"x_m,y_m\r1,2\r3,4\r", "x_m,y_m\r\n1,2\r\n3,4"}) {
    EXPECT_EQ(import_text(text, settings).stroke.size(), 2u);
  }
  EXPECT_THAT(refusal("x_m,y_m\r\n1,2\r\n\r\n3,a\r\n", settings), HasSubstr("in.csv:4"));
  EXPECT_THAT(refusal("x_m,y_m\r1,2\r\r3,a\r", settings), HasSubstr("in.csv:4"));
}

TEST(Dialect, ThousandsAreNotTakenForDecimals) {
  TableSettings settings;
  settings.rate = 10.0;
  settings.position_unit = "mm";
  EXPECT_THAT(refusal("x,y\n\"1,000\",\"12,500\"\n999,\"1,001\"\n", settings),
              HasSubstr("the comma in \"1,000\" may separate thousands or decimals"));
  const std::string decimals = "x,y\n\"1,000\",\"12,500\"\n999,\"1,25\"\n";
  EXPECT_EQ(import_text(decimals, settings).stroke.position[1], Vector3d(0.999, 1.25e-3, 0));
  settings.decimal = DecimalMark::comma;
  EXPECT_EQ(import_text("x,y\n\"1,000\",\"12,500\"\n", settings).stroke.position[0],
            Vector3d(1e-3, 0.0125, 0));
}

TEST(Dialect, WhatIsMissingIsAskedForInOneSentence) {
  const std::string said = refusal("x,y\n1,2\n", {});
  EXPECT_THAT(said, AllOf(HasSubstr("unit of x, y is not known"), HasSubstr("; and the times are unknown")));
  EXPECT_THAT(refusal("x_m,y_px,t_s\n1,2,0\n", {}),
              HasSubstr("unit of x_m, y_px is not the same in all columns (m, px)"));
}

TEST(TableUnits, WholeNumbersBecomeTheNearestDouble) {
  using enum Quantity;
  EXPECT_EQ(unit_of(length, "mm").to_si(123), 0.123);
  EXPECT_EQ(unit_of(length, "cm").to_si(123), 1.23);
  EXPECT_EQ(unit_of(length, "um").to_si(55), 0.000055);
  EXPECT_EQ(unit_of(length, "in").to_si(2), 0.0508);
  EXPECT_EQ(unit_of(length, "m").to_si(0.1), 0.1);
  EXPECT_EQ(unit_of(length, "px", 0.25).to_si(3), 0.75);
  EXPECT_EQ(unit_of(length, "1e-5").to_si(1), 1e-5);
  EXPECT_EQ(unit_of(length, "0.25").to_si(3), 0.75);
  EXPECT_EQ(unit_of(time, "ms").to_si(66), 0.066);
  EXPECT_EQ(unit_of(time, "us").to_si(66), 0.000066);
  EXPECT_EQ(unit_of(time, "ns").to_si(7), 7e-9);
  EXPECT_EQ(unit_of(speed, "mm/s").to_si(3), 0.003);
  EXPECT_EQ(unit_of(force, "N").to_si(3), 3);
  EXPECT_EQ(unit_of(force, "kN").to_si(3), 3000);
}

TEST(TableUnits, UnknownUnitsListTheKnown) {
  const auto complaint = [](Quantity quantity, const char* name) -> std::string {
    try {
      unit_of(quantity, name);
    } catch (const Error& failure) {
      return failure.what();
    }
    return "";
  };
  EXPECT_THAT(complaint(Quantity::length, "furlong"),
              AllOf(HasSubstr("'furlong'"), HasSubstr("mm"), HasSubstr("metres")));
  for (const char* bad : {"-1", "0", "1e999", "nan", "1m"})
    EXPECT_THAT(complaint(Quantity::length, bad), HasSubstr("is not a unit of length")) << bad;
  EXPECT_THAT(complaint(Quantity::length, "px"), HasSubstr("--pixel-size"));
  EXPECT_THAT(complaint(Quantity::time, "fortnight"),
              AllOf(HasSubstr("'fortnight'"), HasSubstr("ms"), Not(HasSubstr("metres"))));
  EXPECT_THAT(complaint(Quantity::speed, "km/week"), HasSubstr("mm/s"));
  EXPECT_THAT(complaint(Quantity::force, "lb"), HasSubstr("mN"));
}

}  // namespace
}  // namespace sandstroke
