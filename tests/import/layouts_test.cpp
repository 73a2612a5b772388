#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

#include "complaint.h"
#include "import/column_name.h"
#include "import/import_stroke.h"
#include "import/text_table.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Times and units that a layout does not say.
TableSettings metres_at_10_hz() {
  TableSettings settings;
  settings.rate = 10.0;
  settings.position_unit = "m";
  return settings;
}

ImportedStroke imported(const std::string& text, const TableSettings& settings = metres_at_10_hz()) {
  return import_stroke_text(text, "in.csv", settings);
}

std::string layout_refusal(const std::string& text, const TableSettings& settings = metres_at_10_hz()) {
  return complaint_of([&] { imported(text, settings); });
}

SampleTable layout_table(const std::string& text, const TableSettings& settings = metres_at_10_hz()) {
  TextTable table("in.csv", settings);
  table.read(text);
  return table.take();
}

struct LaidOut {
  const char* what;
  std::string text;
  Vector3d first = Vector3d(5, 6, 7);
  std::string position = {}, columns = {};
};

class Layouts : public testing::TestWithParam<LaidOut> {};

/// The first sample is at (5, 6, 7), or as the case says.
TEST_P(Layouts, TheColumnsAreFound) {
  TableSettings settings = metres_at_10_hz();
  settings.position = GetParam().position;
  settings.columns = GetParam().columns;
  const ImportedStroke found = imported(GetParam().text, settings);
  EXPECT_EQ(found.stroke.position.at(0), GetParam().first) << found.description;
  EXPECT_EQ(found.stroke.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, Layouts,
    testing::Values(
        // separators at the end of rows, of the header, of both
        LaidOut{"rows end in commas", "x,y,z,b\n5,6,7,0,\n5,6,8,0,\n"},
        LaidOut{"rows end in semicolons", "x;y;z\n5;6;7;\n5;6;8;\n"},
        LaidOut{"rows end in tabs", "x\ty\tz\n5\t6\t7\t\n5\t6\t8\t\n"},
        LaidOut{"rows end in two separators", "x,y,z\n5,6,7,,\n5,6,8,,\n"},
        LaidOut{"the header does, too", "x,y,z,\n5,6,7,\n5,6,8,\n"},
        LaidOut{"only the header does", "x,y,z,,\n5,6,7\n5,6,8\n"},
        LaidOut{"only the header does, by tabs", "x\ty\tz\t\t\n5\t6\t7\n5\t6\t8\n"},
        LaidOut{"some rows do", "x,y,z\n5,6,7,\n5,6,8\n"}, LaidOut{"one row", "x,y,z\n5,6,7,\n5,6,8,\n"},
        LaidOut{"no header", "5,6,7,\n5,6,8,\n", {5, 6, 7}, "1,2,3"},
        LaidOut{"names that are given", "5,6,7,\n5,6,8,\n", {5, 6, 7}, "c,d,e", "c,d,e"},
        LaidOut{"names in a comment", "# x,y,z\n5,6,7,\n5,6,8,\n"},
        LaidOut{"decimal commas", "x;y;z\n5,5;6;7;\n5;6;8;\n", {5.5, 6, 7}},
        LaidOut{"an empty column with a name", "x,y,z,note\n5,6,7,\n5,6,8,\n"},
        LaidOut{"empty rows before the header", ",,\n,,\nx,y,z\n,,\n5,6,7\n5,6,8\n"},
        // rows that have names
        LaidOut{"row names", "x,y,z\n1,5,6,7\n2,5,6,8\n"},
        LaidOut{"row names of text", "x y z\na 5 6 7\nb 5 6 8\n"},
        LaidOut{"row names, and separators at the end", "x,y,z\n1,5,6,7,\n2,5,6,8,\n"},
        LaidOut{"row names with an empty last cell", "x,y,z,b\n1,5,6,7,0\n2,5,6,8,\n"},
        LaidOut{"an index without a name", ",x,y,z\n0,5,6,7\n1,5,6,8\n"},
        // names that are empty
        LaidOut{"tabs begin the header", "\t\tX1\tY1\tZ1\n1\t0\t5\t6\t7\n2\t0.01\t5\t6\t8\n"},
        LaidOut{"tabs begin all lines", "\tx\ty\tz\n\t5\t6\t7\n\t5\t6\t8\n"},
        LaidOut{"an unnamed column is called by its number", ",x,y,\n5,6,3,7\n5,6,3,8\n", {5, 6, 7}, "1,2,4"},
        // names
        LaidOut{"x_pos", "x_pos,y_pos,z_pos\n5,6,7\n5,6,8\n"},
        LaidOut{"X Position (m)", "X Position (m),Y Position (m),Z Position (m)\n5,6,7\n5,6,8\n"},
        LaidOut{"Position X", "Position X,Position Y,Position Z\n5,6,7\n5,6,8\n"},
        LaidOut{"PosX", "PosX,PosY,PosZ\n5,6,7\n5,6,8\n"},
        LaidOut{"pos.x", "pos.x,pos.y,pos.z\n5,6,7\n5,6,8\n"},
        LaidOut{"Position(x)", "Position(x),Position(y),Position(z)\n5,6,7\n5,6,8\n"},
        LaidOut{"x-position", "x-position,y-position,z-position\n5,6,7\n5,6,8\n"},
        LaidOut{"tip x pos", "tip x pos,tip y pos,tip z pos\n5,6,7\n5,6,8\n"},
        LaidOut{"px", "px,py,pz\n5,6,7\n5,6,8\n"},
        LaidOut{"one marker", "Frame,X1,Y1,Z1\n1,5,6,7\n2,5,6,8\n"},
        LaidOut{"one marker of Qualisys",
                "Frame\tTime\ttip X\ttip Y\ttip Z\n1\t0\t5\t6\t7\n2\t.1\t5\t6\t8\n"},
        LaidOut{"MATLAB's splitvars", "pos_1,pos_2,pos_3\n5,6,7\n5,6,8\n"},
        LaidOut{"numbers from 0", "pos[0],pos[1],pos[2]\n5,6,7\n5,6,8\n"},
        LaidOut{
            "UR robots",
            "actual_TCP_pose_0 actual_TCP_pose_1 actual_TCP_pose_2 actual_TCP_pose_3 actual_TCP_pose_4 "
            "actual_TCP_pose_5 target_TCP_pose_0 target_TCP_pose_1 target_TCP_pose_2 actual_q_0 actual_q_1 "
            "actual_q_2\n5 6 7 0 0 0 1 1 1 2 2 2\n5 6 8 0 0 0 1 1 1 2 2 2\n"},
        LaidOut{"Franka robots",
                "O_T_EE[0],O_T_EE[1],O_T_EE[2],O_T_EE[3],O_T_EE[4],O_T_EE[5],O_T_EE[6],O_T_EE[7],O_T_EE[8],"
                "O_T_EE[9],O_T_EE[10],O_T_EE[11],O_T_EE[12],O_T_EE[13],O_T_EE[14],O_T_EE[15],O_T_EE_d[12]\n"
                "1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1,9\n1,0,0,0,0,1,0,0,0,0,1,0,5,6,8,1,9\n"},
        LaidOut{"large letters of which each is there once", "x,y,Z\n5,6,7\n5,6,8\n"},
        LaidOut{"a pen that tilts", "penX,penY,tiltX,tiltY\n5,6,1,1\n5,7,1,1\n", {5, 6, 0}},
        LaidOut{"names twice, chosen by number",
                "Frame,X,Y,Z,W,X,Y,Z,\n0,0,0,0,1,5,6,7,\n1,0,0,0,1,5,6,8,\n",
                {5, 6, 7},
                "6,7,8"}),
    [](const auto& tested) {
      std::string name;
      for (const char c : std::string(tested.param.what))
        if (std::isalnum(static_cast<unsigned char>(c))) name += c;
      return name + std::to_string(tested.index);
    });

TEST(TableLayouts, SeparatorsAndRowNamesAreSaid) {
  EXPECT_THAT(imported("x,y,z\n5,6,7,\n").description,
              AllOf(HasSubstr("3 columns"), HasSubstr("separators at the end of rows")));
  EXPECT_THAT(imported("x,y,z\n1,5,6,7\n").description,
              AllOf(HasSubstr("4 columns"), HasSubstr("names of rows in the first one")));
  EXPECT_THAT(imported("x,y,z\n5,6,7\n").description,
              AllOf(Not(HasSubstr("separators")), Not(HasSubstr("names of rows"))));
}

TEST(TableLayouts, AFieldBeyondTheColumnsIsRefused) {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 70; ++i) text += "5,6,7,\n";
  EXPECT_THAT(layout_refusal(text + "5,6,7,8\n"), HasSubstr("in.csv:72: 4 fields instead of 3 (x, y, z)"));
  EXPECT_THAT(layout_refusal(text + "5,6\n"), HasSubstr("in.csv:72: 2 fields instead of 3"));
  EXPECT_THAT(layout_refusal("a,b,c,d,e\n5,6,7\n5,6,8\n"), HasSubstr("the first line has 5 fields"));
  EXPECT_THAT(layout_refusal("x,y\n1,2,5,6,7\n1,2,5,6,8\n"), HasSubstr("the first line has 2 fields"));
}

TEST(TableLayouts, AShortHeaderLacksTheNamesOfRowsOnlyIfRowsHaveSome) {
  const std::string header = "t_s,x_mm,y_mm\n";
  EXPECT_THAT(layout_refusal(header + "0,1,2,20.5\n0.01,2,2,20.5\n"),
              HasSubstr("the first line has 3 fields (t_s, x_mm, y_mm), but most lines have 4"));
  EXPECT_THAT(layout_refusal(header + "5,1,2,20.5\n6,2,2,20.5\n"), HasSubstr("the first line has 3 fields"));
  for (const char* rows : {"0,0,1,2\n1,0.1,2,2\n", "1,0,1,2\n2,0.1,2,2\n", "a,0,1,2\nb,0.1,2,2\n"})
    EXPECT_EQ(imported(header + rows, {}).stroke.position.at(1), Vector3d(0.002, 0.002, 0)) << rows;
}

TEST(TableLayouts, QuotedNamesAreTrimmed) {
  EXPECT_EQ(imported("\" x_mm \",\" y_mm \"\n1,2\n").stroke.size(), 1u);
  EXPECT_EQ(layout_table("\" x_mm \",\" y_mm \"\n1,2\n").columns[0].unit, "mm");
}

TEST(TableLayouts, EqualCandidatesAreAskedFor) {
  EXPECT_THAT(
      layout_refusal("t,x,y,X,Y,Z\n0,640,480,0.1,0.2,0.3\n"),
      AllOf(HasSubstr("in.csv:1: columns 'X' and 'x' may both be the position"), HasSubstr("--position")));
  EXPECT_THAT(layout_refusal("x [px],y [px],x [m],y [m],z [m]\n1,2,3,4,5\n"),
              HasSubstr("may both be the position"));
  EXPECT_THAT(layout_refusal("X1,Y1,Z1,X2,Y2,Z2\n1,2,3,4,5,6\n"), HasSubstr("'X1' and 'X2' may both be"));
  EXPECT_THAT(layout_refusal("x,y,fx,fy,FX,FY\n1,2,3,4,5,6\n"),
              AllOf(HasSubstr("may both be the force"), HasSubstr("--force), or none")));
  EXPECT_THAT(layout_refusal("x,y,left_fx,left_fy,right_fx,right_fy\n1,2,3,4,5,6\n"), HasSubstr("--force)"));
  EXPECT_THAT(
      layout_refusal("Frame,X,Y,Z,W,X,Y,Z\n0,0,0,0,1,5,6,7\n"),
      HasSubstr("2 columns are named 'X', which are the numbers 2 and 6; give each its own name, or choose "
                "columns by their numbers with stroke.table.position (stroke convert: --position)"));
  TableSettings named = metres_at_10_hz();
  named.position = "X,Y,Z";
  EXPECT_EQ(imported("t,x,y,X,Y,Z\n0,640,480,0.1,0.2,0.3\n", named).stroke.position[0],
            Vector3d(0.1, 0.2, 0.3));
}

TEST(TableLayouts, AFlatPositionBesideOneInSpaceIsAskedFor) {
  for (const char* others : {"pos_x,pos_y,pos_z", "position.x,position.y,position.z", "PosX,PosY,PosZ",
                             "x_pos,y_pos,z_pos", "tip_x,tip_y,tip_z", "px,py,pz", "pos.1,pos.2,pos.3",
                             "pos_x_m,pos_y_m,pos_z_m", "hand_x,hand_y,hand_z"})
    for (const char* flat : {"x,y", "x_px,y_px"})
      EXPECT_THAT(layout_refusal(std::string("t,") + flat + "," + others + "\n0,640,480,0.1,0.2,0.3\n"),
                  AllOf(HasSubstr("may both be the position"), HasSubstr("only the second has a height"),
                        HasSubstr("--position)")))
          << others;
  EXPECT_THAT(layout_refusal("x_px,y_px,pos_x,pos_y\n640,480,0.1,0.2\n"), HasSubstr("their units differ"));
  for (const char* fine :
       {"x,y,z,tip_x,tip_y,tip_z", "x,y,z,target_x,target_y,target_z", "x,y,target_x,target_y,target_z,b"})
    EXPECT_EQ(imported(std::string(fine) + "\n1,2,0,4,5,6\n").stroke.position[0], Vector3d(1, 2, 0)) << fine;
}

TEST(TableLayouts, ALoneHeightIsTold) {
  for (const char* name : {"pos_z", "z_pos", "tip.z"})
    EXPECT_THAT(imported("x,y," + std::string(name) + "\n1,2,3\n").warnings,
                ElementsAre(AllOf(HasSubstr("column '" + std::string(name) + "' may be its height"),
                                  HasSubstr("\"x,y," + std::string(name) + "\""))));
  EXPECT_THAT(imported("x,y,target_z\n1,2,3\n").warnings, ElementsAre());
}

TEST(TableLayouts, RivalsOutsideThePositionAreTold) {
  TableSettings timed = metres_at_10_hz();
  timed.rate = 0.0;
  timed.time_unit = "s";
  const auto twice = HasSubstr("2 columns are named");
  EXPECT_THAT(layout_refusal("t,x,y,t\n0,1,2,0\n1,1,3,2\n", timed), AllOf(twice, HasSubstr("--time)")));
  EXPECT_THAT(layout_refusal("x,y,pressure,pressure\n1,2,3,4\n"), AllOf(twice, HasSubstr("--pressure)")));
  EXPECT_THAT(layout_refusal("x,y,pen_down,pen_down\n1,2,1,0\n"), AllOf(twice, HasSubstr("--pen-state)")));
  for (const char* names : {"time,x,y,Time", "time,x,y,timestamp"})
    EXPECT_THAT(imported(std::string(names) + "\n0,1,2,0\n1,1,3,2\n", timed).warnings,
                ElementsAre(AllOf(HasSubstr("'time' and '"), HasSubstr("equally good"), HasSubstr("--time"))))
        << names;
  const ImportedStroke found = imported("x,y,vx,vy,VX,VY\n1,2,3,4,5,6\n");
  EXPECT_THAT(found.stroke.velocity, ElementsAre());
  EXPECT_THAT(found.description, HasSubstr("velocity left out: columns"));
}

TEST(TableLayouts, AVectorWithoutAnAxisOfThePositionIsLeftOut) {
  TableSettings settings = metres_at_10_hz();
  settings.position = "x,z";
  settings.force_unit = "N";
  const ImportedStroke found = imported("x,z,fx,fy\n1,2,3,4\n", settings);
  EXPECT_THAT(found.stroke.force, ElementsAre());
  EXPECT_THAT(found.warnings, ElementsAre(AllOf(HasSubstr("the force is left out"), HasSubstr("--force)"))));
}

TEST(TableLayouts, NamesOfOtherQuantitiesAreNoPosition) {
  for (const char* names :
       {"TX,TY,TZ", "accX,accY,accZ", "x_accel,y_accel,z_accel", "x_target,y_target,z_target",
        "joint_position_0,joint_position_1,joint_position_2", "pos_1,pos_2,pos_3,pos_4"}) {
    std::string numbers = "1,2,3,4";
    numbers.resize(std::string(names).find("pos_4") == std::string::npos ? 5 : 7);
    EXPECT_THAT(layout_refusal(std::string(names) + "\n" + numbers + "\n"), HasSubstr("--position)"))
        << names;
  }
}

TEST(TableUnitsInWords, AreRead) {
  struct Case {
    const char* text;
    Vector3d position;
    double time;
  };
  TableSettings none;
  for (const Case& one :
       {Case{"Frame,Time (Seconds),X (Meters),Y (meters),Z (METERS)\n0,0,0,0,0\n1,0.5,1,2,3\n",
             {1, 2, 3},
             0.5},
        {"time [sec],x [Millimetres],y [Millimetres]\n0,0,0\n0.5,1,2\n", {0.001, 0.002, 0}, 0.5},
        {"Time,X,Y\nSeconds,Inches,inches\n0,0,0\n0.5,1,2\n", {0.0254, 0.0508, 0}, 0.5},
        {"Time,X,Y,angle\n(ms),(microns),(microns),(degrees)\n0,0,0,1\n5,1,2,1\n", {1e-6, 2e-6, 0}, 0.005},
        {"Time\tX\tY\nmilliseconds\tcentimeters\tcentimeters\t\n0\t0\t0\n5\t1\t2\n", {0.01, 0.02, 0}, 0.005},
        {"Sub Frame,T_MS,X_MM,Y_MM\n0,0,0,0\n0,5,1,2\n", {0.001, 0.002, 0}, 0.005},
        {"seconds,x_m,y_m\n0,0,0\n5,1,2\n", {1, 2, 0}, 5}}) {
    const Stroke stroke = imported(one.text, none).stroke;
    EXPECT_EQ(stroke.position.at(1), one.position) << one.text;
    EXPECT_EQ(stroke.time.at(1), one.time) << one.text;
  }
}

TEST(TableUnitsInWords, UnknownOnesNameTheFileTheColumnAndTheOption) {
  EXPECT_THAT(layout_refusal("t [fortnights],x_m,y_m\n0,1,2\n", {}),
              HasSubstr("in.csv: the unit of the times 't [fortnights]' is 'fortnights', which is none; give "
                        "stroke.table.time_unit (stroke convert: --time-unit): s, ms, us, ns"));
  EXPECT_THAT(layout_refusal("t [s],x [ticks],y [ticks]\n0,1,2\n", {}),
              AllOf(HasSubstr("in.csv: the unit of x [ticks], y [ticks]: 'ticks' is not a unit of length"),
                    HasSubstr("--position-unit"), HasSubstr("or a number of metres")));
  TableSettings settings = metres_at_10_hz();
  settings.force_unit = "MN";
  EXPECT_THAT(layout_refusal("x,y,fx,fy\n1,2,3,4\n", settings),
              AllOf(HasSubstr("'MN' is not a unit of force"), HasSubstr("--force-unit"),
                    HasSubstr("or a number of newtons")));
  settings.force_unit = "0.5";
  EXPECT_EQ(imported("x,y,fx,fy\n1,2,3,4\n", settings).stroke.force[0], Vector3d(1.5, 2, 0));
  EXPECT_EQ(imported("x,y,fx [kgf],fy [kgf]\n1,2,1,2\n").stroke.force[0], Vector3d(9.80665, 19.6133, 0));
}

TEST(TableUnitsInWords, EachColumnHasItsOwn) {
  const ImportedStroke found = imported("t_s,x_mm,y_mm,z_cm,fx_N,fy_mN\n0,1,2,3,4,5\n", {});
  EXPECT_EQ(found.stroke.position[0], Vector3d(0.001, 0.002, 0.03));
  EXPECT_EQ(found.stroke.force[0], Vector3d(4, 0.005, 0));
  EXPECT_THAT(found.description, HasSubstr("position x_mm, y_mm, z_cm (mm, mm, cm)"));
}

TEST(TableUnitsInWords, AnOptionThatDisagreesIsTold) {
  TableSettings settings = metres_at_10_hz();
  EXPECT_THAT(imported("x_mm,y_mm\n1,2\n", settings).warnings,
              ElementsAre(AllOf(HasSubstr("column 'x_mm' is in mm by the file, but is read in m"),
                                HasSubstr("--position-unit"))));
  EXPECT_THAT(imported("x_px,y_px\n1,2\n", settings).warnings,
              testing::Contains(HasSubstr("column 'x_px' is in px by the file, but is read in m")));
  EXPECT_THAT(imported("x_m,y_mm\n1,2\n", settings).warnings, ElementsAre(HasSubstr("column 'y_mm'")));
  settings.position_unit = "0.001";
  EXPECT_THAT(imported("x_mm,y_mm\n1,2\n", settings).warnings, ElementsAre());
  settings.rate = 0.0;
  settings.time_unit = "s";
  EXPECT_THAT(imported("t_ms,x_mm,y_mm\n1,1,2\n", settings).warnings,
              ElementsAre(AllOf(HasSubstr("column 't_ms' is in ms"), HasSubstr("--time-unit"))));
}

TEST(TableUnitsInWords, MinutesToDaysAndFeetToKilometresAreKnown) {
  struct Case {
    const char* text;
    double time, x;
  };
  for (const Case& one : {Case{"t_min,x_ft,y_ft\n0,0,0\n1,1,0\n", 60.0, 0.3048},
                          {"Time (hours),x_dm,y_dm\n0,0,0\n1,1,0\n", 3600.0, 0.1},
                          {"time [day],x_km,y_km\n0,0,0\n1,1,0\n", 86400.0, 1000.0},
                          {"time_min,time_s,x_nm,y_nm\n0,0,0,0\n1,60,1,0\n", 60.0, 1e-9}}) {
    const Stroke stroke = imported(one.text, {}).stroke;
    EXPECT_EQ(stroke.time.at(1), one.time) << one.text;
    EXPECT_EQ(stroke.position.at(1).x(), one.x) << one.text;
  }
  for (const char* name : {"x_min", "day", "hour"})
    EXPECT_EQ(column_name(name).means, ColumnName::Means::other) << name;
}

/// The values of a column, with -1 for a missing one.
std::vector<double> values(const SampleTable& table, const std::string& name) {
  std::vector<double> all = column(table, name).values;
  for (double& value : all)
    if (std::isnan(value)) value = -1.0;
  return all;
}

TEST(TableMissing, CellsWithoutAValueAreNaN) {
  for (const char* nothing : {"", "NaN", "nan", "-nan", "N/A", "NA", "n/a", "null", "NULL", "None", "-", "--",
                              "#N/A", "#NUM!", "#DIV/0!", "nan(ind)", "-nan(ind)", "1.#QNAN"}) {
    const std::string row = std::string(nothing) + "," + nothing;
    const SampleTable table =
        layout_table("a,x,y,fx,fy\n0,1,2," + row + "\n1," + row + "," + row + "\n2,3,4,5,6\n");
    EXPECT_EQ(table.size(), 3u) << nothing;
    EXPECT_THAT(values(table, "x"), ElementsAre(1, -1, 3)) << nothing;
    EXPECT_THAT(values(table, "fy"), ElementsAre(-1, -1, 6)) << nothing;
  }
  EXPECT_THAT(values(layout_table("t_s;x;y\n0;1,5;2\n;-;2,5\n"), "x"), ElementsAre(1.5, -1));
  TableSettings timed = metres_at_10_hz();
  timed.rate = 0.0;
  EXPECT_THAT(
      values(layout_table("t,x,y\n,1,2\n1700000000123456789,1,2\n1700000000123456790,1,2\n", timed), "t"),
      ElementsAre(-1, 0, 1));
  EXPECT_EQ(layout_table("x\ty\n1\t2\n\t\n3\t4\n").size(), 3u) << "a row of tabs is a row without values";
  EXPECT_EQ(layout_table("x\ty\tz\n1\t2\t3\n\t\n\n3\t4\t5\n").size(), 2u) << "a single tab is a blank line";
}

TEST(TableMissing, AnEmptyHeightOffersAFlatStroke) {
  for (const char* text : {"x,y,z\n1,2,\n3,4,\n", "x,y,z,b\n1,2,NaN,1\n3,4,,1\n"})
    EXPECT_THAT(layout_refusal(text), AllOf(HasSubstr("in.csv: column 'z' has no value in any sample"),
                                            HasSubstr("if the stroke is flat"), HasSubstr("to \"x,y\"")));
}

/// A sample that begins with one keeps its place on the clock of a rate.
TEST(TableMissing, ErrorsOfSpreadsheetsAreNoComments) {
  for (const char* error : {"#N/A", "#REF!", "#DIV/0!", "#VALUE!", "#NUM!", "#NAME?", "#NULL!"})
    for (const char* separator : {",", ";", "\t", " "}) {
      const auto row = [&](const std::string& x, const std::string& y) { return x + separator + y + "\n"; };
      std::string rows;
      for (int i = 0; i < 70; ++i) rows += row("1", "2");
      const std::string text = row("x", "y") + row(error, "2") + row("3", "4") + row(error, error) + rows +
                               row(error, "5") + "# " + error + "\n" + row("6", error);
      const SampleTable table = layout_table(text);
      EXPECT_EQ(table.size(), 75u) << text;
      EXPECT_EQ(values(table, "x")[0], -1) << text;
      EXPECT_EQ(values(table, "x")[73], -1) << text;
      EXPECT_EQ(values(table, "y")[73], 5) << text;
      const Stroke stroke = imported(text).stroke;
      EXPECT_NEAR(stroke.time[1] - stroke.time[0], 0.2, 1e-12) << text;
      EXPECT_FALSE(stroke.joined(0)) << text;
    }
  EXPECT_EQ(layout_table("#N/A: no marker was seen\nx,y\n1,2\n#N/A marks the end of a part\n3,4\n").size(),
            2u);
}

TEST(TableMissing, TextInAUsedColumnIsRefused) {
  EXPECT_THAT(layout_refusal("x,y,note\n1,2,a\n3,b,c\n"),
              HasSubstr("in.csv:3: column 'y': 'b' is not a finite number"));
  EXPECT_THAT(layout_refusal("x,y\n1,2\n3,inf\n"), HasSubstr("'inf' is not a finite number"));
  EXPECT_EQ(imported("x,y,note\n1,2,a\n3,4,inf\n").stroke.size(), 2u) << "in others it does no harm";
}

TEST(TableMissing, TheSeparatorIsFoundBesideEmptyCells) {
  EXPECT_THAT(layout_table("t_s,x,y,z,a,b,c\n0,1,2,,,,\n").description,
              HasSubstr("commas, decimal points, 7 columns"));
  EXPECT_THAT(layout_table("t_s;x;y;z;a\n0,5;;;;\n1,5;1,5;2;;\n").description,
              HasSubstr("semicolons, decimal commas"));
  EXPECT_THAT(layout_table("t_s\tx\ty\tz\n0\t\t\t\n1\t1\t2\t\n2\t\t3\t\n").description, HasSubstr("tabs"));
  EXPECT_THAT(layout_table("x y z\nnan nan nan\nnan nan nan\n").description, HasSubstr("spaces"));
}

TEST(TablePen, LiftsWhereTheStrokeNumberChanges) {
  for (const char* name : {"stroke", "stroke_id", "strokeNumber", "Stroke Index"}) {
    const ImportedStroke found = imported(std::string(name) + ",x,y\n0,1,1\n0,2,1\n1,5,5\n1,6,5\n");
    EXPECT_THAT(found.stroke.contact, ElementsAre(pen_down, pen_lifts, pen_down, pen_down)) << name;
    EXPECT_THAT(found.description, HasSubstr(": 2 strokes, between which the pen lifts"));
    EXPECT_THAT(found.warnings, ElementsAre());
  }
  const ImportedStroke letters = imported("stroke,x,y\na,1,1\na,2,1\nb,5,5\nb,6,5\na,7,7\na,8,8\n");
  EXPECT_THAT(letters.stroke.contact,
              ElementsAre(pen_down, pen_lifts, pen_down, pen_lifts, pen_down, pen_down));
  for (const char* labels : {"A1B2", "1A2B", "A1A1", "AB12", "12AB"}) {
    std::string text = "stroke,x,y\n";
    for (int i = 0; i < 8; ++i) text += std::string(1, labels[i / 2]) + ",1," + std::to_string(i) + "\n";
    EXPECT_THAT(imported(text).stroke.contact, ElementsAre(pen_down, pen_lifts, pen_down, pen_lifts, pen_down,
                                                           pen_lifts, pen_down, pen_down))
        << labels;
  }
  const std::string lengths = "stroke,x,y\n12,1,1\n12.5,2,1\n13,5,5\n13.5,6,5\n";
  EXPECT_THAT(imported(lengths).stroke.contact, ElementsAre());
  EXPECT_THAT(imported(lengths).warnings,
              ElementsAre(HasSubstr("'stroke' changes too often to number strokes")));
}

TEST(TablePen, IsDownWhereItsStateIsNot0) {
  const auto down = [](const std::string& text) { return imported(text).stroke.contact; };
  const auto expected = ElementsAre(pen_down, pen_up, pen_down);
  for (const char* name : {"pen", "pen_state", "PenDown", "tip_down"})
    EXPECT_THAT(down(std::string(name) + ",x,y\n1,1,1\n0,2,1\n1,3,1\n"), expected) << name;
  for (const char* name : {"penup", "pen_up"})
    EXPECT_THAT(down(std::string(name) + ",x,y\n0,1,1\n1,2,1\n0,3,1\n"), expected) << name;
  EXPECT_THAT(down("pen,x,y\nTrue,1,1\nFalse,2,1\nTrue,3,1\n"), expected);
  EXPECT_THAT(down("pen,x,y\nDOWN,1,1\nUP,2,1\nDOWN,3,1\n"), expected);
  for (const char* words : {"PD,PU", "contact,hover", "T,F", "y,n", "pen,air", "touch,hovering"}) {
    const std::vector<std::string> word = parts_of_list(words);
    const std::string rows = word[0] + ",1,1\n" + word[1] + ",2,1\n" + word[0] + ",3,1\n";
    EXPECT_THAT(down("pen,x,y\n" + rows), expected) << words;
  }
  EXPECT_THAT(imported("pen,x,y\nred,1,1\nblue,2,1\n").stroke.contact, ElementsAre());
  EXPECT_THAT(imported("pen,x,y\nred,1,1\nblue,2,1\n").warnings,
              ElementsAre(AllOf(HasSubstr("'pen' is not taken for the pen's state, because 'red'"),
                                HasSubstr("--pen-state"))));
  TableSettings settings = metres_at_10_hz();
  settings.pen_state = "pen";
  EXPECT_THAT(layout_refusal("pen,x,y\nmaybe,1,1\n", settings), HasSubstr("column 'pen': 'maybe'"));
  EXPECT_THAT(imported("pen,x,y\n1,1,1\n0,2,1\n").description,
              HasSubstr("pen state pen: up where it is 0, in 1"));
  const ImportedStroke never = imported("pen,x,y\n0,1,1\n0,2,1\n");
  EXPECT_THAT(never.stroke.contact, ElementsAre());
  EXPECT_THAT(never.warnings, ElementsAre(HasSubstr("'pen' would lift the pen in all samples")));
  EXPECT_THAT(imported("pen,x,y\n1,1,1\n2,2,1\n").warnings,
              ElementsAre(HasSubstr("'pen' changes but never lifts")));
}

TEST(TablePen, PrefixesOfItsColumnsDoNotHideIt) {
  for (const char* before : {"tip.", "rec_", "pen/", "msg.", "pos_", "stylus.", "state."}) {
    const std::string name = before;
    EXPECT_THAT(imported("x,y," + name + "pen_down\n1,1,1\n2,1,0\n3,1,1\n").stroke.contact,
                ElementsAre(pen_down, pen_up, pen_down))
        << name;
    EXPECT_THAT(imported("x,y," + name + "strokeId\n1,1,1\n2,1,1\n3,1,2\n4,1,2\n").stroke.contact,
                ElementsAre(pen_down, pen_lifts, pen_down, pen_down))
        << name;
  }
  EXPECT_THAT(imported("{\"p\":{\"x\":1,\"y\":1},\"state\":{\"pen_down\":true}}\n"
                       "{\"p\":{\"x\":2,\"y\":1},\"state\":{\"pen_down\":false}}\n"
                       "{\"p\":{\"x\":3,\"y\":1},\"state\":{\"pen_down\":true}}\n")
                  .stroke.contact,
              ElementsAre(pen_down, pen_up, pen_down));
  EXPECT_THAT(imported("x,y,rec.pen_down,pen_down\n1,1,1,1\n2,1,1,0\n3,1,1,1\n").stroke.contact,
              ElementsAre(pen_down, pen_up, pen_down))
      << "the plainest counts";
  for (const char* other : {"target.pen_down", "not_pen_down", "x_pen", "vel_stroke"})
    EXPECT_EQ(column_name(other).means, ColumnName::Means::other) << other;
}

TEST(TablePen, ColumnsThatPerhapsTellOfItAreTold) {
  const auto warnings = [](const std::string& name, const std::string& values) {
    std::string text = "x,y," + name + "\n";
    int row = 0;
    for (const std::string& value : parts_of_list(values))
      text += std::to_string(++row) + ",1," + value + "\n";
    return imported(text).warnings;
  };
  for (const char* name : {"hover", "hovering", "up", "is_up", "lifted", "tip", "finger.touch", "event"})
    EXPECT_THAT(warnings(name, "0,0,1,1"),
                ElementsAre(AllOf(HasSubstr("changes between 0 and 1"), HasSubstr("--pen-state"))))
        << name;
  for (const char* name : {"seg", "trace", "polyline", "contour", "pen_id", "rec.segment_id"})
    EXPECT_THAT(warnings(name, "1,1,2,2"), ElementsAre(HasSubstr("--stroke-number"))) << name;
  TableSettings settings = metres_at_10_hz();
  settings.pen_state = "hover";
  EXPECT_THAT(imported("x,y,hover\n1,1,0\n2,1,1\n3,1,0\n", settings).stroke.contact,
              ElementsAre(pen_down, pen_up, pen_down));
}

TEST(TablePen, EventsOfAPointerAreTold) {
  const std::string text = "x,y,event\n1,1,down\n2,1,move\n3,1,up\n4,1,move\n";
  EXPECT_THAT(imported(text).warnings, ElementsAre(AllOf(HasSubstr("'event'"), HasSubstr("--pen-state"))));
  TableSettings settings = metres_at_10_hz();
  settings.pen_state = "event";
  EXPECT_THAT(imported(text, settings).stroke.contact, ElementsAre(pen_down, pen_down, pen_up, pen_up));
  EXPECT_THAT(imported("x,y,state\n1,1,down\n2,1,up\n").warnings, ElementsAre(HasSubstr("'state'")));
  EXPECT_THAT(imported("x,y,trace\n1,1,a\n2,1,a\n3,1,b\n4,1,b\n").warnings,
              ElementsAre(HasSubstr("--stroke-number")));
  settings.pen_state = "hover";
  EXPECT_THAT(imported("x,y,hover\n1,1,contact\n2,1,hover\n", settings).stroke.contact,
              ElementsAre(pen_down, pen_up));
}

TEST(TablePen, ColumnsCanBeNamed) {
  TableSettings settings = metres_at_10_hz();
  const std::string text = "button,part,x,y\n1,1,1,1\n0,1,2,1\n1,2,3,1\n1,2,3,3\n";
  EXPECT_THAT(imported(text, settings).stroke.contact, ElementsAre());
  EXPECT_THAT(imported(text, settings).warnings,
              ElementsAre(AllOf(HasSubstr("'button' changes between 0 and 1"), HasSubstr("--pen-state")),
                          AllOf(HasSubstr("'part' changes 1 times"), HasSubstr("--stroke-number"))));
  settings.pen_state = "button";
  settings.stroke_number = "part";
  EXPECT_THAT(imported(text, settings).stroke.contact, ElementsAre(pen_down, pen_up, pen_down, pen_down));
  EXPECT_THAT(imported(text, settings).warnings, ElementsAre());
  settings.pen_state = "-button";
  settings.stroke_number = "";
  EXPECT_THAT(imported(text, settings).stroke.contact, ElementsAre(pen_up, pen_down, pen_up, pen_up));
  settings.stroke_number = "word";
  EXPECT_THAT(layout_refusal(text, settings), HasSubstr("column 'word' is missing"));
}

TEST(TableJson, LinesOfNumbersAreATable) {
  const ImportedStroke found = imported(
      "{\"stamp\":1700000000123456789,\"pos\":{\"x\":5,\"y\":6.5,\"z\":7},\"name\":\"a\"}\n"
      "{\"pos\":{\"x\":5,\"y\":6,\"z\":8},\"stamp\":1700000000123456790,\"name\":\"b, c\"}\n",
      [] {
        TableSettings settings;
        settings.position_unit = "m";
        return settings;
      }());
  EXPECT_THAT(found.stroke.position, ElementsAre(Vector3d(5, 6.5, 7), Vector3d(5, 6, 8)));
  EXPECT_THAT(found.stroke.time, ElementsAre(0.0, 1e-9));
  EXPECT_THAT(found.description, HasSubstr("lines of JSON, 5 columns, 2 rows"));
  EXPECT_EQ(imported("{\"pos\":[5,6,7]}\n{\"pos\":[5,6,8]}\n").stroke.position[0], Vector3d(5, 6, 7));
  EXPECT_THAT(values(layout_table("{\"x\":1,\"y\":2}\n{\"x\":null}\n"), "x"), ElementsAre(1, -1));
  EXPECT_THAT(layout_refusal("{\"x\":1,\"y\":2}\n{\"x\":1,\"q\":2}\n"),
              HasSubstr("in.csv:2: 'q' is not in the first"));
  EXPECT_THAT(layout_refusal("{\"x\":1,\"y\":2}\n{\"x\":1,\n"), HasSubstr("in.csv:2: is not a JSON object"));
  EXPECT_THAT(layout_refusal("{\"x\":1,\"y\":2}\n{\"x\":1,\"y\":\"b\"}\n"),
              HasSubstr("in.csv:2: column 'y': 'b'"));
  EXPECT_NE(layout_refusal("{\"word\":\"line\",\"drawing\":[[[1,2],[3,4]]]}\n"), "");
}

/// As Python's json.dumps writes them, also where nobody reads them.
TEST(TableJson, NumbersThatJsonLacksAreMissing) {
  const SampleTable table = layout_table(
      "{\"x\": 1, \"y\": 2, \"f\": NaN, \"n\": \"NaN\"}\n{\"x\": NaN, \"y\": -Infinity, \"n\": \"a \\\" "
      "NaN\"}\n"
      "{\"x\":Infinity,\"y\":-4,\"n\":\"\\\\\",\"f\":-Infinity}\n");
  EXPECT_THAT(values(table, "x"), ElementsAre(1, -1, -1));
  EXPECT_THAT(values(table, "y"), ElementsAre(2, -1, -4));
  EXPECT_EQ(
      imported("{\"pos\":[5,6,7],\"f\":[NaN,0]}\n{\"pos\":[NaN,6,8]}\n{\"pos\":[5,6,8]}\n").stroke.size(),
      2u);
  EXPECT_THAT(layout_refusal("{\"x\":1,\"y\":2}\n{\"x\":nope,\"y\":NaN}\n"),
              HasSubstr("in.csv:2: is not a JSON"));
}

/// Of lines with many names, some of which others lack, each value is in its column.
TEST(TableJson, ManyNamesKeepTheirColumns) {
  std::string first = "{\"x\":1,\"y\":2", second = "{\"y\":4,\"x\":3";
  for (int i = 0; i < 2000; ++i) {
    const std::string pair = ",\"k" + std::to_string(i) + "\":" + std::to_string(i);
    first += pair;
    if (i % 3 != 0) second += pair;
  }
  const SampleTable table = layout_table(first + "}\n" + second + "}\n{\"x\":5}\n");
  EXPECT_EQ(table.columns.size(), 2002u);
  EXPECT_THAT(values(table, "x"), ElementsAre(1, 3, 5));
  EXPECT_THAT(values(table, "y"), ElementsAre(2, 4, -1));
}

TEST(TableClocks, InTwoColumnsAreOne) {
  for (const char* names :
       {"sec,nanosec", "secs,nsecs", "header.stamp.sec,header.stamp.nanosec", "stamp_sec,stamp_nanosec"}) {
    TableSettings settings;
    const ImportedStroke found = imported(
        std::string(names) + ",x_m,y_m\n1573151162,999999999,1,2\n1573151163,0,1,3\n1573151163,7,1,4\n",
        settings);
    EXPECT_THAT(found.stroke.time, ElementsAre(0.0, 1e-9, 8e-9)) << names;
    EXPECT_EQ(found.clock, 1573151162999999999) << names;
    EXPECT_THAT(found.description, HasSubstr("one clock of")) << names;
    EXPECT_THAT(found.description, Not(HasSubstr("not used"))) << names;
  }
  const std::string text = "a,t_msec,t_sec,x_m,y_m\n0,900,4,1,2\n0,0,5,1,3\n";
  EXPECT_THAT(imported(text, {}).stroke.time, ElementsAre(0.0, 0.1)) << "of milliseconds, in another order";
  TableSettings settings;
  settings.time = "tv_sec,tv_usec";
  EXPECT_THAT(imported("tv_sec,tv_usec,x_m,y_m\n4,900000,1,2\n5,1,1,3\n", settings).stroke.time,
              ElementsAre(0.0, 0.100001));
  settings.time = "x_m,y_m";
  EXPECT_THAT(layout_refusal("t_sec,x_m,y_m\n4,1,2\n", settings),
              HasSubstr("does not say whether it counts ms, us or ns"));
}

TEST(TableClocks, TwoClocksAreNotJoined) {
  const ImportedStroke found = imported("t_sec,t_msec,x_m,y_m\n0,0,1,2\n1.5,1500,1,3\n", {});
  EXPECT_THAT(found.stroke.time, ElementsAre(0.0, 1.5));
  EXPECT_THAT(found.description, HasSubstr("not used: t_msec"));
  const std::string totals = "t_sec,t_msec,x_m,y_m\n0,0,1,2\n1,1500,1,3\n";
  EXPECT_THAT(imported(totals, {}).stroke.time, ElementsAre(0.0, 1.5));
  EXPECT_THAT(imported(totals, {}).warnings,
              ElementsAre(AllOf(HasSubstr("'t_sec' and 't_msec' are two times"), HasSubstr("--time"))));
  TableSettings named;
  named.time = "t_sec,t_msec";
  EXPECT_THAT(
      layout_refusal(totals, named),
      AllOf(HasSubstr("in.csv:3: column 't_msec' is taken for the ms of the whole seconds in 't_sec', "
                      "but 1500 is not between 0 and 999"),
            HasSubstr("--time")));
}

}  // namespace
}  // namespace sandstroke
