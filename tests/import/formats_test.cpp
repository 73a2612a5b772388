#include "import/formats.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "complaint.h"
#include "import/import_stroke.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A file of that name and content, read.
std::optional<SampleTable> sampled(const std::string& name, std::string_view content,
                                   const std::string& part = "") {
  const TestFolder folder;
  put_text(folder / name, content);
  TableSettings settings;
  settings.part = part;
  return read_known_format(folder / name, settings);
}

std::string description(const std::string& name, std::string_view content) {
  const std::optional<SampleTable> table = sampled(name, content);
  return table ? table->description : "text";
}

TEST(Formats, AreKnownByContent) {
  EXPECT_THAT(description("track.txt", "; sand\nG21\nG1 X1 Y1\n"), StartsWith("G-code"));
  EXPECT_THAT(description("pen.dat", ".VERSION 1.0\n.COORD X Y\n.PEN_DOWN\n1 2\n"), StartsWith("UNIPEN"));
  EXPECT_THAT(description("pen", "\xEF\xBB\xBF<?xml version='1.0'?>\n<ink><trace>1 2</trace></ink>"),
              StartsWith("InkML"));
  EXPECT_THAT(description("a.txt", "<?xml version='1.0'?><svg><path d='M1 1h1'/></svg>"), StartsWith("SVG"));
  EXPECT_THAT(description("a.txt", "IN;SP1;PU0,0;PD40,40;"), StartsWith("HPGL"));
}

/// The name of Inkscape's namespace begins as InkML's root does.
TEST(Formats, AnSvgFromInkscapeIsNoInkml) {
  EXPECT_THAT(
      description(
          "drawing.svg",
          "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"no\"?>\n<!-- Created with Inkscape "
          "(http://www.inkscape.org/) -->\n\n<svg\n   width=\"210mm\"\n   height=\"297mm\"\n   "
          "viewBox=\"0 0 210 297\"\n   version=\"1.1\"\n   inkscape:version=\"1.2.2\"\n   "
          "sodipodi:docname=\"drawing.svg\"\n   "
          "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"\n   "
          "xmlns:sodipodi=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\"\n   "
          "xmlns=\"http://www.w3.org/2000/svg\">\n  <sodipodi:namedview id=\"n\" "
          "inkscape:zoom=\"1\" />\n  <g inkscape:label=\"Layer 1\" inkscape:groupmode=\"layer\">\n    "
          "<path d=\"M 10,10 H 50\" sodipodi:nodetypes=\"cc\" />\n  </g>\n</svg>\n"),
      StartsWith("SVG"));
  for (const char* ink : {"<ink>", "<ink xmlns='http://www.w3.org/2003/InkML'>",
                          "<ink\n xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape'>"})
    EXPECT_THAT(description("a.txt", std::string(ink) + "<trace>1 2, 3 4</trace></ink>"),
                StartsWith("InkML"));
  EXPECT_THAT(description("a.txt",
                          "<q:ink xmlns:q='http://www.w3.org/2003/InkML'><q:trace>1 2, 3 "
                          "4</q:trace></q:ink>"),
              StartsWith("InkML"));
}

TEST(Formats, OrByEndingWhereContentCannotTell) {
  EXPECT_THAT(description("track.THR", "0 0\n1 1\n"), StartsWith("theta-rho"));
  EXPECT_THAT(description("track.nc", "X1 Y1\nX2\n"), StartsWith("G-code"));
}

TEST(Formats, OtherTextIsLeftToTables) {
  EXPECT_EQ(description("a.csv", "x,y\n1,2\n"), "text");
  EXPECT_EQ(description("a.txt", "0 0\n1 1\n"), "text");
  EXPECT_EQ(description("a.csv", "G1,G2\n1,2\n"), "text");
  EXPECT_EQ(description("a.csv", "[mm],[s]\n1,2\n"), "text");
  EXPECT_EQ(description("a.csv", std::string_view("\xFF\xFEx\0,\0y\0\n\0", 10)), "text");  // UTF-16
  EXPECT_EQ(description("a.csv", "PAR1,PAR2\n1,2\n"), "text");
  EXPECT_EQ(description("a.tsv", "ARROW1\tARROW2\n1\t2\n"), "text");
  EXPECT_EQ(description("a.csv", "MATLAB export of trial 3\nx,y\n1,2\n"), "text");
  EXPECT_EQ(description("stroke.toml", "[[segment]]\nkind = 'line'\n"), "text");
  EXPECT_EQ(description("empty", ""), "text");
  EXPECT_FALSE(read_known_format("-"));
}

TEST(Formats, KindsThatAreNotReadAreNamedWithTheWayOut) {
  const struct {
    std::string name;
    std::string_view content;
    const char *kind, *way_out;
  } files[] = {
      {"a.bag", "#ROSBAG V1.2\n", "a ROS 1 bag of another version", "rosbag fix"},
      {"a.bag", "#ROSRECORD V1.1\n", "an old ROS 1 bag", "rosbag fix"},
      {"a.mcap", "\x89MCAP1\r\n", "an MCAP file of another version", "ros2 bag convert"},
      {"a.xlsx", "PK\x03\x04...", "an Excel file", "CSV"},
      {"a.ods", "PK\x03\x04...", "a spreadsheet", "CSV"},
      {"a.zip", "PK\x03\x04...", "a zip archive", "unpack"},
      {"a.xls", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1", "an old Excel", "CSV"},
      {"a", "PAR1\x15\x04...", "a Parquet file", "to_csv"},
      {"a", std::string_view("ARROW1\0\0...", 11), "a Feather file", "to_csv"},
      {"a.npy", "\x93NUMPY\x01", "damaged or unknown header", "numpy.save"},
      {"a.npz", "PK\x03\x04...", "damaged or cut off zip", "save it again"},
      {"a.h5", "\x89HDF\r\n\x1A\n", "an HDF5 file", "CSV"},
      {"a.csv", "%PDF-1.5", "a PDF", "name the file"},
      {"a.csv", "\x1F\x8B\x08", "packed by gzip", "gunzip"},
      {"a.json", "{\"x\": [1, 2]}", "JSON", "CSV"},
      {"a", "\n [ [1, 2], [3, 4]]", "JSON", "CSV"},
      {"a.dat", std::string_view("\x01\x02\0\0\x05", 5), "neither text", "CSV"},
      {"a.db", std::string_view("SQLite format 3\0", 16), "", ""},
      {"a.mat", "x", "not a MATLAB file", "save it again"},
  };
  for (const auto& file : files)
    EXPECT_THAT(complaint_of([&] { sampled(file.name, file.content); }),
                AllOf(HasSubstr(file.name), HasSubstr(file.kind), HasSubstr(file.way_out)));
}

TEST(Formats, OnlySomeHaveParts) {
  EXPECT_THAT(complaint_of([] { sampled("a.thr", "0 0\n", "/tool"); }), HasSubstr("leave out --part /tool"));
}

TEST(Formats, OnlyGcodeAndTablesHaveWordsForThePen) {
  const TestFolder folder;
  for (const auto& [name, content] :
       std::initializer_list<std::pair<const char*, const char*>>{{"a.thr", "0 0\n1 1\n"},
                                                                  {"a.svg", "<svg><path d='M1 1h1'/></svg>"},
                                                                  {"a.plt", "IN;PU0,0;PD40,40;"}}) {
    const std::filesystem::path file = folder / name;
    put_text(file, content);
    for (std::string TableSettings::*key : {&TableSettings::pen_up, &TableSettings::pen_down}) {
      TableSettings settings;
      settings.*key = "UP";
      EXPECT_THAT(complaint_of([&] { read_known_format(file, settings); }),
                  HasSubstr("its format tells itself where the pen is up; leave out stroke.table.pen_"));
    }
  }
  put_text(folder / "a.csv", "x,y,t\n1,2,3\n");
  TableSettings settings;
  settings.pen_down = "DOWN";
  EXPECT_THAT(complaint_of([&] { import_stroke(folder / "a.csv", settings); }), HasSubstr("pen_down"));
}

TEST(Formats, OnlyTablesOfTextHaveKeysForText) {
  const TestFolder folder;
  for (const auto& [name, content] : std::initializer_list<std::pair<const char*, const char*>>{
           {"a.thr", "0 0\n1 1\n"},
           {"a.gcode", "G21\nG1 X1 Y1 F600\nX2\n"},
           {"a.svg", "<svg><path d='M1 1h1'/></svg>"}}) {
    const std::filesystem::path file = folder / name;
    put_text(file, content);
    for (const auto& [key, change] : std::initializer_list<std::pair<const char*, void (*)(TableSettings&)>>{
             {"columns", [](TableSettings& s) { s.columns = "t,x,y,z"; }},
             {"separator", [](TableSettings& s) { s.separator = Separator::tab; }},
             {"decimal", [](TableSettings& s) { s.decimal = DecimalMark::comma; }},
             {"encoding", [](TableSettings& s) { s.encoding = "latin1"; }},
             {"skip_lines", [](TableSettings& s) { s.skip_lines = 1; }},
             {"skip", [](TableSettings& s) { s.skip = "a"; }}}) {
      TableSettings settings;
      change(settings);
      EXPECT_THAT(complaint_of([&] { read_known_format(file, settings); }),
                  AllOf(HasSubstr(name), HasSubstr(std::string("stroke.table.") + key), HasSubstr("leave")));
    }
  }
  TableSettings settings;
  settings.columns = "a,b";
  EXPECT_THAT(complaint_of([&] { import_stroke_text("{\"x\":1,\"y\":2}\n", "in", settings); }),
              HasSubstr("lines of JSON name the columns themselves; leave out stroke.table.columns"));
}

TEST(Formats, AFolderOrNothingIsNoFile) {
  const TestFolder folder;
  for (const char* name : {".", "not there"}) {
    try {
      read_known_format(folder / name);
      FAIL();
    } catch (const Error& failure) {
      EXPECT_EQ(failure.kind(), ErrorKind::io);
    }
  }
}

}  // namespace
}  // namespace sandstroke
