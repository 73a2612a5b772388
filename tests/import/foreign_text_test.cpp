// Text of other programs: named for what it is, with a command that makes a table of it. The commands are
// run.
#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <fstream>

#include "complaint.h"
#include "core/child_process.h"
#include "import/formats.h"
#include "import/import_stroke.h"
#include "real_client.h"
#include "sanitized.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string complaint_about(const std::filesystem::path& file) {
  return complaint_of([&] { read_known_format(file); });
}

constexpr const char* quick_draw =
    "{\"word\":\"line\",\"key_id\":\"1\",\"drawing\":[[[10,20,30],[10,10,15]],[[10,30],[40,40]]]}\n"
    "{\"word\":\"line\",\"key_id\":\"2\",\"drawing\":[[[1,2],[3,4]]]}\n";
constexpr const char* json_lines =  // with texts in a list: flat ones are a table
    "{\"x\": 1, \"y\": 2, \"t\": 0, \"tags\": [\"a\"]}\n{\"x\": 3, \"y\": 4, \"t\": 0.01, \"tags\": []}\n";
constexpr const char* json = "[{\"x\": 1, \"y\": 2, \"t\": 0},\n {\"x\": 3, \"y\": 4, \"t\": 0.01}]\n";
constexpr const char* ros1_echo =
    "header: \n  seq: 1\n  stamp: \n    secs: 1573151162\n    nsecs: 990000000\n  frame_id: \"base\"\npose: "
    "\n"
    "  position: \n    x: 1\n    y: 2\n    z: 0.3\n---\n"
    "header: \n  seq: 2\n  stamp: \n    secs: 1573151163\n    nsecs: 0\n  frame_id: \"base\"\npose: \n"
    "  position: \n    x: 3\n    y: 4\n    z: 0.3\n---\n";
constexpr const char* ros2_echo =
    "header:\n  stamp:\n    sec: 1573151162\n    nanosec: 990000000\n  frame_id: base\npoint:\n  x: 1\n  y: "
    "2\n  z: 3\n"
    "---\n"
    "header:\n  stamp:\n    sec: 1573151163\n    nanosec: 0\n  frame_id: base\npoint:\n  x: 3\n  y: 4\n  z: "
    "3\n---\n";
constexpr const char* plain_echo = "x: 1\ny: 2\ntime: 0\n---\nx: 3\ny: 4\ntime: 0.01\n---\n";

TEST(ForeignText, IsNamedForWhatItIs) {
  const TestFolder folder;
  const struct {
    const char *name, *text, *kind;
  } files[] = {
      {"a.ndjson", quick_draw, "a file of Quick Draw"},
      {"a.txt", quick_draw, "a file of Quick Draw"},
      {"a", json_lines, "JSON lines"},
      {"a.jsonl", "{\"x\": 1}", "JSON lines"},
      {"a.txt", json, "JSON, which"},
      {"a.txt", "[[1,2],[3,4]]", "JSON, which"},
      {"a.txt", ros1_echo, "YAML, as rostopic echo prints it"},
      {"a.yaml", "x: 1\n", "YAML, which"},
      {"a.txt", plain_echo, "YAML, which"},
      {"a.txt", "  0\nSECTION\n  2\nHEADER\n", "a DXF drawing"},
      {"a.DXF", "  0\n", "a DXF drawing"},
      {"a.bvh", "HIERARCHY\nROOT Hips\n", "a BVH file"},
      {"a.gpx", "<?xml version='1.0'?><gpx/>", "a GPX track"},
      {"a.xml", "<?xml version='1.0'?><data/>", "XML, but neither InkML nor SVG"},
      {"a", "<!DOCTYPE html>\n<html><svg/></html>", "HTML"},
      {"a.ps", "%!PS-Adobe-3.0\n", "a PostScript drawing"},
      {"a.csv", "version https://git-lfs.github.com/spec/v1\noid sha256:5\nsize 9\n", "a pointer of Git LFS"},
      {"a.mat", "version https://git-lfs.github.com/spec/v1\noid sha256:5\nsize 9\n", "git lfs pull"},
      {"a.h5", "/annex/objects/SHA256-s9--5\n", "git annex get"},
  };
  for (const auto& file : files) {
    put_text(folder / file.name, file.text);
    EXPECT_THAT(complaint_about(folder / file.name), AllOf(HasSubstr(file.name), HasSubstr(file.kind)))
        << file.text;
  }
}

TEST(ForeignText, TablesThatLookAlikeAreTables) {
  const TestFolder folder;
  for (const char* text : {"# date: 1\n---\n1 2\n", "x y\n--- ---\n1 2\n", "[mm] [s]\n1 2\n", "[[segment]]\n",
                           "Recorded on: 2024\n---\nx,y\n1,2\n", "12:30:01,1,2\n---\n",
                           "---\nname: trial 3\nfields:\n- name: t\n- name: x\n---\nt,x\n0,1\n1,2\n",
                           "subject: 4\n---\n0;1,5\n1;2,5\n",
                           "subject: 4\n---\nt x\n2024-05-01T12:00:00 1 2\n2024-05-01T12:00:01 1 2\n"}) {
    put_text(folder / "a.txt", text);
    EXPECT_EQ(complaint_about(folder / "a.txt"), "") << text;
  }
}

TEST(ForeignText, IsATableIfItsLinesAreChosen) {
  const TestFolder folder;
  put_text(folder / "a.csv", "subject: 4\n---\nx_m,y_m\n1,2\n3,4\n");
  TableSettings settings;
  settings.rate = 10.0;
  settings.skip_lines = 2;
  EXPECT_EQ(import_stroke(folder / "a.csv", settings).stroke.size(), 2u);
  put_text(folder / "b.csv", "---\nsubject: 4\n---\nx_m,y_m\n");
  for (const int skipped : {0, 3}) {
    settings.skip_lines = skipped;
    EXPECT_EQ(complaint_of([&] { read_known_format(folder / "b.csv", settings); }).empty(), skipped == 3);
  }
}

/// The command in a sentence, run in the folder.
void run_way_out(const std::string& sentence, const std::filesystem::path& folder) {
  const std::size_t begin = sentence.find("python3 -c "), end = sentence.rfind(", and name");
  ASSERT_NE(begin, std::string::npos) << sentence;
  std::string command = sentence.substr(begin, end == std::string::npos ? end : end - begin);
  command.replace(0, std::string("python3").size(), python);
  const auto result = run_child({"/bin/sh", "-c", "cd '" + folder.string() + "' && " + command});
  ASSERT_TRUE(result && result->exit_code == 0) << command << "\n" << (result ? result->err : "");
}

class WayOut : public testing::Test {
  void SetUp() override {
    if (sanitized) GTEST_SKIP() << "no sanitizer sees what other programs do";
    SANDSTROKE_NEEDS(python_has("pandas, yaml"), "python3-pandas or python3-yaml");
  }
};

TEST_F(WayOut, MakesATableThatIsRead) {
  constexpr const char* nested =
      "[{\"t\": 0, \"pos\": {\"x\": 1, \"y\": 2}},\n {\"t\": 0.01, \"pos\": {\"x\": 3, \"y\": 4}}]\n";
  constexpr const char* columns = "{\"t\": [0, 0.01],\n \"x\": [1, 3],\n \"y\": [2, 4]}\n";
  constexpr const char* list = "---\n- {x: 1, y: 2, time: 0}\n- {x: 3, y: 4, time: 0.01}\n---\n";
  for (const char* text : {json_lines, json, nested, columns, ros1_echo, ros2_echo, plain_echo, list}) {
    const TestFolder folder;
    const auto file = folder / "it's \"a\" $file.txt";
    put_text(file, text);
    run_way_out(complaint_about(file), folder.path());
    TableSettings settings;
    settings.position_unit = "mm";
    if (std::string_view(text).find("stamp") == std::string_view::npos) settings.time_unit = "s";
    const Stroke stroke = import_stroke(folder / "samples.csv", settings).stroke;
    ASSERT_EQ(stroke.size(), 2u) << text;
    EXPECT_NEAR(stroke.position[0].x(), 0.001, 1e-12) << text;
    EXPECT_NEAR(stroke.position[1].y(), 0.004, 1e-12) << text;
    EXPECT_NEAR(stroke.time[1] - stroke.time[0], 0.01, 1e-9) << text;
  }
}

TEST_F(WayOut, MakesPenStrokesOfAQuickDrawing) {
  const TestFolder folder;
  put_text(folder / "cats.ndjson", quick_draw);
  const std::string sentence = complaint_about(folder / "cats.ndjson");
  EXPECT_THAT(sentence, HasSubstr("> drawing.csv, and name that with --pen-up UP"));
  run_way_out(sentence, folder.path());
  TableSettings settings;
  settings.pen_up = "UP";
  settings.position_unit = "mm";
  settings.speed = 0.1;
  const Stroke stroke = import_stroke(folder / "drawing.csv", settings).stroke;
  ASSERT_EQ(stroke.size(), 5u);
  EXPECT_NEAR(stroke.position[2].y(), -0.015, 1e-12);
  EXPECT_EQ(stroke.contact[2], pen_lifts);
  EXPECT_EQ(stroke.contact[3], pen_down);
}

}  // namespace
}  // namespace sandstroke
