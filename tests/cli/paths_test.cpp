// Content that is read may lead the program to files, not to devices, and never to write elsewhere; and no
// name is taken for anything but a name.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "browser.h"
#include "cli/program.h"
#include "hdf5/hdf5_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

const std::string small_bed = "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n";

TEST(CliPaths, AFileNamesOnlyFiles) {
  const fs::path folder = test_folder();
  ASSERT_EQ(mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
  write_file(folder / "sweep.toml", "[sweep]\nscene = \"bad.toml\"\n[axes]\nforce.k_s = [500.0, 1000.0]\n");
  for (const std::string file : {"pipe.toml", "/dev/zero", "/dev/stdin"}) {
    write_file(folder / "bad.toml", small_bed + "[stroke]\nfile = \"" + file + "\"\n");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"run", "bad.toml", "-o", "out.h5"},
          {"sweep", "sweep.toml", "-o", "out"}}) {
      const ProgramResult result = run_program(command, folder);
      EXPECT_EQ(result.exit_code, 4) << file;
      EXPECT_NE(result.err.find(file + ": is not a regular file"), std::string::npos) << result.err;
    }
    write_file(folder / "bad.toml", small_bed + "surface = { kind = \"file\", file = \"" + file + "\" }\n");
    const ProgramResult result = run_program({"run", "bad.toml", "-o", "out.h5"}, folder);
    EXPECT_EQ(result.exit_code, 4) << file;
    write_file(folder / "plan.toml",
               "[sweep]\nscene = \"" + file + "\"\n[axes]\nforce.k_s = [500.0, 1000.0]\n");
    EXPECT_EQ(run_program({"sweep", "plan.toml", "-o", "out"}, folder).exit_code, 4) << file;
  }
}

TEST(CliPaths, ALinkInPlaceOfAnUnfinishedFileIsNotWrittenThrough) {
  const fs::path folder = test_folder();
  write_file(folder / "precious", "text");
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "4"}, folder).exit_code, 0);
  for (const char* part : {"out.h5.part", "out.png.part", "out.mp4.part", "golden.xml.part"})
    fs::create_symlink("precious", folder / part);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"run", "scene.toml", "-o", "out.h5"},
        {"render", "a.h5", "-o", "out.png"},
        {"render", "a.h5", "--video", "out.mp4"},
        {"stroke", "script", "line.toml", "out.h5"},
        {"compare", "a.h5", "a.h5", "--junit", "golden.xml"}}) {
    const ProgramResult result = run_program(command, folder);
    EXPECT_EQ(result.exit_code, 4) << command[0];
    EXPECT_NE(result.err.find("is a link"), std::string::npos) << result.err;
  }
  EXPECT_EQ(read_file(folder / "precious"), "text");
  for (const char* name : {"out.h5", "out.png", "out.mp4"}) EXPECT_FALSE(fs::exists(folder / name)) << name;
}

TEST(CliPaths, ARunWithHeightsInAnotherFileIsNotDrawn) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  fs::copy(folder / "a.h5", folder / "b.h5");
  {
    const Hdf5Handle file(H5Fopen((folder / "b.h5").c_str(), H5F_ACC_RDWR, without_locks()), H5Fclose);
    ASSERT_GE(H5Ldelete(file, "/surface/final", H5P_DEFAULT), 0);
    ASSERT_GE(H5Lcreate_external("a.h5", "/surface/final", file, "/surface/final", H5P_DEFAULT, H5P_DEFAULT),
              0);
  }
  const ProgramResult result = run_program({"render", "b.h5"}, folder);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("b.h5: /surface/final is missing"), std::string::npos) << result.err;
}

TEST(CliPaths, NamesMayBeAnyBytesWhereNoTextHoldsThem) {
  const fs::path folder = test_folder();
  fs::copy(folder / "scene.toml", folder / "s\xff.toml");
  fs::copy(folder / "line.toml", folder / "l\xff.toml");
  const ProgramResult run = run_program({"run", "s\xff.toml", "--png", "p\xff.png", "--json"}, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"info", "s\xff.h5", "--json"},
        {"render", "s\xff.h5", "-o", "again\xff.png"},
        {"compare", "s\xff.h5", "s\xff.h5", "--report", "report\xff", "--junit", "j\xff.xml"},
        {"stroke", "script", "l\xff.toml", "l\xff.h5"},
        {"stroke", "info", "l\xff.h5", "--json"}}) {
    const ProgramResult result = run_program(command, folder);
    EXPECT_EQ(result.exit_code, 0) << command.front() << ": " << result.err;
  }
  EXPECT_TRUE(std::string_view(read_file(folder / "j\xff.xml")).find('\xff') == std::string_view::npos);
  const ProgramResult refused =
      run_program({"run", "scene.toml", "--stroke", "l\xff.toml", "-o", "b.h5"}, folder);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("is not UTF-8"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(folder / "b.h5"));
}

TEST(CliPaths, AGoldenNameIsNoPath) {
  const fs::path folder = test_folder();
  for (const char* name : {"strokes/dune", "other"}) {
    fs::create_directories(folder / name);
    fs::copy(folder / "scene.toml", folder / name);
    fs::copy(folder / "line.toml", folder / name);
  }
  fs::create_directory(folder / "golden");
  const ProgramResult result = run_program({"golden", "update", "../other"}, folder);
  EXPECT_EQ(result.exit_code, 2) << result.out;
  EXPECT_TRUE(fs::exists(folder / "other/scene.toml"));
  EXPECT_FALSE(fs::exists(folder / "other/golden.h5"));
  EXPECT_EQ(run_program({"golden", "check", "../other"}, folder).exit_code, 2);
}

TEST(CliPaths, NamesAreNoCommands) {
  const fs::path above = test_folder();
  const std::string odd = "; touch bad; $(touch bad) `touch bad` ' \" | touch bad\n&& touch bad";
  const fs::path folder = above / odd;
  fs::create_directory(folder);
  for (const char* file : {"scene.toml", "line.toml"}) fs::copy(above / file, folder);
  const auto place = [&](const std::string& name) { return odd + "/" + name; };
  const auto run = [&](const std::vector<std::string>& words) {
    const ProgramResult result = run_program(words, above);
    EXPECT_EQ(result.exit_code, 0) << words[0] << ": " << result.err;
  };
  write_file(folder / "sweep.toml", "[sweep]\nscene = \"scene.toml\"\n[axes]\nforce.k_s = [500.0, 1000.0]\n");
  run({"run", place("scene.toml"), "-o", place("a.h5"), "--frames", "4", "--png", place("a.png")});
  run({"render", place("a.h5"), "-o", place("b.png")});
  run({"compare", place("a.h5"), place("a.h5"), "--report", place("report"), "--junit", place("a.xml")});
  run({"sweep", place("sweep.toml"), "-o", place("sweep")});
  run({"info", place("a.h5")});
  for (const fs::path& there : {above, folder}) EXPECT_FALSE(fs::exists(there / "bad"));
}

using CliOddNames = BrowserTest;

TEST_F(CliOddNames, PagesShowNamesAndRunNothing) {
  const fs::path above = test_folder();
  // The slash between the folders makes an end of a script in the middle.
  const std::string odd =
      "it's \"<img src=x onerror=\"document.documentElement.dataset.hacked=1\"><"
      "/script><script>document.documentElement.dataset.hacked=1<"
      "/script>{a|b}{b}`${1}\u2028\u2029&lt;";
  const fs::path folder = above / odd;
  fs::create_directories(folder);
  for (const char* file : {"scene.toml", "line.toml"}) fs::copy(above / file, folder);
  write_file(folder / "sweep.toml", "[sweep]\nscene = \"scene.toml\"\n[axes]\nforce.k_s = [500.0, 1000.0]\n");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", odd + "/scene.toml", "-o", odd + "/a.h5", "--png", odd + "/a.png"},
        {"report", odd + "/a.h5", "-o", "run.html"},
        {"compare", odd + "/a.h5", odd + "/a.h5", "--report", "runs"},
        {"compare", odd + "/a.png", odd + "/a.png", "--report", "pictures"},
        {"sweep", odd + "/sweep.toml", "-o", "sweep"}}) {
    const ProgramResult result = run_program(words, above);
    ASSERT_EQ(result.exit_code, 0) << words[0] << ": " << result.err;
  }
  for (const char* page : {"run.html", "runs/compare.html", "pictures/compare.html", "sweep/sweep.html"}) {
    const OpenedPage opened = open_page(read_file(above / page), page_state);
    EXPECT_TRUE(opened.console.empty()) << opened.console.front();
    EXPECT_EQ(opened.answer[0], "true") << page;
    EXPECT_EQ(opened.answer[2], 0) << page;
    EXPECT_EQ(opened.dom.find("data-hacked"), std::string::npos) << page;
  }
}

}  // namespace
}  // namespace sandstroke
