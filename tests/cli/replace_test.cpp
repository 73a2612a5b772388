// An output replaces what sandstroke wrote there for the same purpose, and nothing else unasked.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <map>

#include "any_hdf5.h"
#include "cli/program.h"
#include "hdf5/hdf5_file.h"
#include "io/png_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// A command and what it writes. Each can be run again and again, where it replaces its own.
struct Writer {
  Words words;
  std::vector<std::string> outputs;
  bool replaces_own = true;
};

const std::vector<Writer> writers = {
    {{"run", "scene.toml", "-o", "b.h5", "--png", "b.png"}, {"b.h5", "b.xdmf", "b.png"}},
    {{"run", "scene.toml"}, {"scene.h5", "scene.xdmf"}},
    {{"render", "a.h5"}, {"a.png"}},
    {{"render", "a.h5", "--frame", "all"}, {"a_frames/frame_0000.png"}},
    {{"report", "a.h5"}, {"a.html"}},
    {{"export", "a.h5", "-o", "e.png"}, {"e.png"}},
    {{"export", "a.h5", "-o", "e.stl"}, {"e.stl"}},
    {{"export", "a.h5", "-o", "e.ply"}, {"e.ply"}},
    {{"export", "a.h5", "-o", "e.obj"}, {"e.obj"}},
    {{"export", "a.h5", "-o", "e.csv"}, {"e.csv"}},
    {{"export", "a.h5", "-o", "e.npy"}, {"e.npy"}, false},
    {{"export", "a.h5", "-o", "e.asc"}, {"e.asc"}, false},
    {{"compare", "a.h5", "a.h5", "--report", "page", "--junit", "j.xml"}, {"page/compare.html", "j.xml"}},
    {{"golden", "check", "--report", "pages", "--all-pages", "--junit", "g.xml"},
     {"pages/tiny.html", "pages/index.html", "g.xml"}},
    {{"golden", "update", "tiny"},
     {"golden/tiny/golden.h5", "golden/tiny/picture.png", "golden/tiny/provenance.toml"}},
    {{"stroke", "script", "line.toml", "s.h5"}, {"s.h5"}, false},
    {{"stroke", "convert", "table.csv", "t.h5", "--rate", "100", "--position", "x,y,z", "--position-unit",
      "m"},
     {"t.h5"},
     false},
    {{"sweep", "collect", "sweep"}, {"sweep/sweep.h5", "sweep/sweep.csv", "sweep/sweep.html"}},
};

/// A folder with a scene and its golden entry.
fs::path folder_with_golden_scene() {
  const fs::path folder = test_folder(), scenes = folder / "strokes/tiny";
  fs::create_directories(scenes);
  for (const char* file : {"scene.toml", "line.toml"}) fs::copy(folder / file, scenes);
  const ProgramResult made = run_program({"golden", "update", "tiny"}, folder);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  return folder;
}

/// A folder with the files that all writers read.
fs::path folder_for_writers() {
  const fs::path folder = folder_with_golden_scene();
  write_file(folder / "table.csv", "x,y,z\n0,0,0\n0.01,0,0\n");
  write_file(folder / "sweep.toml", "[sweep]\nscene = \"scene.toml\"\n[axes]\nforce.k_s = [500.0, 1000.0]\n");
  for (const Words& words :
       {Words{"run", "scene.toml", "-o", "a.h5", "--frames", "1"}, {"sweep", "sweep.toml", "-o", "sweep"}}) {
    const ProgramResult made = run_program(words, folder);
    EXPECT_EQ(made.exit_code, 0) << words[0] << made.err;
  }
  return folder;
}

/// Files of others by their endings, as like sandstroke's as may be.
std::map<std::string, std::string> foreign_contents(const fs::path& folder) {
  {
    Hdf5Writer file(folder / "foreign", any_hdf5);
    file.write("/stroke/time", std::vector<double>{0.0, 0.1});
    file.attribute("/stroke", "format", "sandstroke.stroke");
    file.finish();
  }
  std::string picture = encode_png(Image(1, 1));
  const std::size_t text = picture.find("Software") - 8;
  picture.erase(text, picture.find("IDAT") - 4 - text);
  return {{".h5", read_file(folder / "foreign")},
          {".png", picture},
          {".html", "<!DOCTYPE html>\n<title>sandstroke</title>\n"},
          {".xml", "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"pytest\"></testsuites>\n"},
          {".xdmf", "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n  </Domain>\n</Xdmf>\n"},
          {".csv", "point,x\n0,1\n"},
          {".toml", "version = \"1\"\n"},
          {".stl", "solid sandstroke\nendsolid\n"},
          {".ply", "ply\nformat binary_little_endian 1.0\ncomment by hand\nend_header\n"},
          {".obj", "# by hand\nv 0 0 0\n"},
          {".npy", "\x93NUMPY"},
          {".asc", "ncols 1\n"}};
}

void expect_refusal(const Words& words, const fs::path& folder, const fs::path& place, int exit_code,
                    const std::string& sentence) {
  const std::string before = read_file(folder / place);
  const ProgramResult refused = run_program(words, folder);
  EXPECT_EQ(refused.exit_code, exit_code) << words[0] << " at " << place << ": " << refused.err;
  EXPECT_NE(refused.err.find(place.string() + ": " + sentence), std::string::npos)
      << words[0] << " at " << place << ": " << refused.err;
  EXPECT_EQ(read_file(folder / place), before) << words[0] << " at " << place;
}

TEST(CliReplace, FilesOfOthersStay) {
  const fs::path folder = folder_for_writers();
  const std::map<std::string, std::string> foreign = foreign_contents(folder);
  for (const Writer& writer : writers)
    for (const fs::path output : writer.outputs) {
      fs::create_directories((folder / output).parent_path());
      const std::string before = read_file(folder / output), alike = foreign.at(output.extension());
      write_file(folder / output, alike);
      expect_refusal(writer.words, folder, output, 2,
                     writer.replaces_own ? "already exists and is not " : "already exists; ");
      write_file(folder / output, before);  // nothing, or what another one reads
    }
}

TEST(CliReplace, UnfinishedFilesOfOthersStay) {
  const fs::path folder = folder_for_writers();
  for (const Writer& writer : writers) {
    if (writer.words[1] == "update") continue;  // which makes its files elsewhere
    const fs::path part = writer.outputs.front() + ".part";
    fs::create_directories((folder / part).parent_path());
    write_file(folder / part, "precious");
    expect_refusal(writer.words, folder, part, 2,
                   writer.replaces_own ? "already exists and is not " : "already exists; ");
    fs::remove(folder / part);
  }
}

TEST(CliReplace, OnlyRunsAreReplacedByARun) {
  const fs::path folder = folder_for_writers();
  const Words run = {"run", "scene.toml", "-o", "b.h5"};
  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "s.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"record", "--max-skipped", "100", "-o", "hand.h5", "--device", "scripted:line.toml",
                         "--duration", "0.1"},
                        folder)
                .exit_code,
            0);
  for (const char* other :
       {"s.h5", "hand.h5", "golden/tiny/golden.h5", "sweep/sweep.h5", "sweep/points/000000.h5"}) {
    fs::copy_file(folder / other, folder / "b.h5");
    expect_refusal(run, folder, "b.h5", 2, "already exists and is not a run file that sandstroke wrote");
    fs::remove(folder / "b.h5");
  }
  fs::remove(folder / "s.h5");
  fs::copy_file(folder / "hand.h5", folder / "s.h5.part");
  expect_refusal({"stroke", "script", "line.toml", "s.h5"}, folder, "s.h5.part", 2, "already exists");
  fs::rename(folder / "s.h5.part", folder / "s.h5");  // a recording cannot be made again
  expect_refusal({"stroke", "script", "line.toml", "s.h5"}, folder, "s.h5", 2, "already exists");
}

TEST(CliReplace, OwnFilesAreReplacedAndKeepTheirModes) {
  const fs::path folder = folder_for_writers();
  for (int again = 0; again < 2; ++again)
    for (const Writer& writer : writers) {
      if (!writer.replaces_own) continue;
      const ProgramResult result = run_program(writer.words, folder);
      EXPECT_EQ(result.exit_code, 0) << writer.words[0] << result.err;
      for (const std::string& output : writer.outputs) {
        if (again) {
          EXPECT_EQ(fs::status(folder / output).permissions(), fs::perms(0600)) << output;
        }
        fs::permissions(folder / output, fs::perms(0600));
      }
    }
}

TEST(CliReplace, WhatCannotBeKnownOrMadeAgainStaysUnlessItIsToBeOverwritten) {
  const fs::path folder = folder_for_writers();
  for (const Writer& writer : writers) {
    if (writer.replaces_own) continue;
    const std::string output = writer.outputs.front();
    ASSERT_EQ(run_program(writer.words, folder).exit_code, 0);
    expect_refusal(writer.words, folder, output, 2, "already exists; name another file, or add --overwrite");
    const std::string made = read_file(folder / output);
    write_file(folder / output, "");
    if (writer.words[0] == "stroke")
      expect_refusal(writer.words, folder, output, 2,
                     "already exists; name another file, or add --overwrite");
    Words overwrite = writer.words;
    overwrite.push_back("--overwrite");
    EXPECT_EQ(run_program(overwrite, folder).exit_code, 0);
    EXPECT_EQ(read_file(folder / output).size(), made.size());
  }
}

TEST(CliReplace, NoHdf5FileHasTheNameOfAnotherFormat) {
  const fs::path folder = folder_for_writers();
  write_file(folder / "hand.h5.recording", "a journal");
  const std::vector<Words> commands = {
      {"run", "scene.toml", "-o", "OUT"},
      {"stroke", "script", "line.toml", "OUT"},
      {"stroke", "convert", "table.csv", "OUT", "--rate", "100", "--position", "x,y,z", "--position-unit",
       "m"},
      {"stroke", "repair", "hand.h5", "OUT"},
      {"record", "--max-skipped", "100", "--device", "scripted:line.toml", "--duration", "0.1", "-o", "OUT"}};
  const auto with = [](Words words, const std::string& name) {
    std::replace(words.begin(), words.end(), std::string("OUT"), name);
    return words;
  };
  for (const Words& command : commands)
    for (const char* name : {"new.csv", "new.png", "new.h5.part"}) {
      const ProgramResult refused = run_program(with(command, name), folder);
      EXPECT_EQ(refused.exit_code, 2) << name << refused.err;
      EXPECT_NE(refused.err.find(std::string(name) + ": a"), std::string::npos) << refused.err;
      EXPECT_NE(refused.err.find(" is an HDF5 file; give it a name that ends with .h5\n"), std::string::npos)
          << refused.err;
      EXPECT_FALSE(fs::exists(folder / name)) << name;
      EXPECT_FALSE(fs::exists(folder / (std::string(name) + ".part"))) << name;
    }
  for (const char* name : {"a.hdf5", "no-ending", "run-27.5"})
    EXPECT_EQ(run_program(with(commands[0], name), folder).exit_code, 0) << name;
  const Words overwrite = {"run", "scene.toml", "-o", "new.csv", "--overwrite"};
  EXPECT_EQ(run_program(overwrite, folder).exit_code, 2);  // it lets files be replaced, no names be wrong
}

TEST(CliReplace, WhatIsProtectedAndLinksAreRefused) {
  const fs::path folder = test_folder();
  const Words words = {"run", "scene.toml", "-o", "s.h5"};
  ASSERT_EQ(run_program(words, folder).exit_code, 0);
  fs::permissions(folder / "s.h5", fs::perms(0444));
  expect_refusal(words, folder, "s.h5", 4, "is write-protected");
  fs::permissions(folder / "s.h5", fs::perms(0644));
  fs::rename(folder / "s.h5", folder / "a.h5");
  fs::create_symlink("a.h5", folder / "s.h5");
  expect_refusal(words, folder, "s.h5", 4, "is a link");
  fs::remove(folder / "s.h5");
  write_file(folder / "s.h5", "");  // as mktemp makes it
  EXPECT_EQ(run_program(words, folder).exit_code, 0);
}

TEST(CliReplace, OverwriteReplacesAnyFileButNoInput) {
  const fs::path folder = test_folder();
  for (const char* name : {"a.h5", "a.h5.part", "a.xdmf"}) write_file(folder / name, "anything");
  const ProgramResult result = run_program({"run", "scene.toml", "-o", "a.h5", "--overwrite"}, folder);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const char* name : {"a.h5", "a.xdmf"}) EXPECT_NE(read_file(folder / name), "anything");
  expect_refusal({"run", "scene.toml", "-o", "scene.toml", "--overwrite"}, folder, "scene.toml", 2,
                 "is named twice");
}

TEST(CliReplace, NoFilmIsReplacedAndNoPageOfOthersBeforeLongWork) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "5"}, folder).exit_code, 0);
  for (const char* name : {"f.mp4", "stress.html", "bench.html", "bench.csv", "bench.h5"})
    write_file(folder / name, "precious");
  expect_refusal({"render", "a.h5", "--video", "f.mp4"}, folder, "f.mp4", 2, "already exists");
  expect_refusal({"stress", "-o", "."}, folder, "./stress.html", 2, "already exists");
  for (const char* name : {"./bench.html", "./bench.csv", "./bench.h5"}) {
    expect_refusal({"bench", "-o", "."}, folder, name, 2, "already exists");
    fs::remove(folder / name);
  }
}

TEST(CliReplace, APageIsNoInput) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  fs::copy(folder / "a.h5", folder / "compare.html");
  const std::string before = read_file(folder / "compare.html");
  EXPECT_EQ(run_program({"compare", "a.h5", "compare.html", "--report", "."}, folder).exit_code, 2);
  EXPECT_EQ(read_file(folder / "compare.html"), before);
}

TEST(CliReplace, AGoldenEntryKeepsTheFilesOfOthers) {
  const fs::path folder = folder_with_golden_scene(), entry = folder / "golden/tiny";
  write_file(entry / "notes.txt", "precious");
  fs::permissions(entry / "notes.txt", fs::perms(0400));
  fs::create_directory(entry / "more");
  write_file(entry / "more/deep.txt", "precious");
  fs::create_symlink("notes.txt", entry / "link");
  fs::permissions(entry, fs::perms(0700));
  write_file(folder / "strokes/tiny/scene.toml",
             read_file(folder / "scene.toml") + "[relaxation]\ntalus_angle = 30.1\n");
  const std::string before = read_file(entry / "provenance.toml");
  const ProgramResult update = run_program({"golden", "update", "tiny"}, folder);
  ASSERT_EQ(update.exit_code, 0) << update.err;
  EXPECT_NE(read_file(entry / "provenance.toml"), before);
  EXPECT_EQ(read_file(entry / "notes.txt"), "precious");
  EXPECT_EQ(fs::status(entry / "notes.txt").permissions(), fs::perms(0400));
  EXPECT_EQ(read_file(entry / "more/deep.txt"), "precious");
  EXPECT_EQ(fs::read_symlink(entry / "link"), "notes.txt");
  EXPECT_EQ(fs::status(entry).permissions(), fs::perms(0700));
  EXPECT_EQ(std::distance(fs::directory_iterator(entry), fs::directory_iterator()), 6);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "golden"), fs::directory_iterator()), 1);
}

TEST(CliReplace, ANameWithoutRoomForItsEndingIsRefusedBeforeTheWork) {
  const fs::path folder = test_folder();
  const std::string longest(252, 'x');  // with .part 257: more than a file system's 255
  for (const Words& words : {Words{"run", "scene.toml", "-o", longest},
                             {"run", "scene.toml", "-o", std::string(247, 'x') + ".h5"},  // its .xdmf.part
                             {"stroke", "script", "line.toml", longest}}) {
    const ProgramResult result = run_program(words, folder);
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err.find("File name too long"), std::string::npos) << result.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 2);
  }
}

TEST(CliOutput, ThatCannotBePrintedIsAnErrorOfEveryCommand) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  for (const Words& words : {Words{"--version"},
                             {"--help"},
                             {"run", "--help"},
                             {"help"},
                             {"help", "scene"},
                             {"help", "--man"},
                             {"info", "a.h5"},
                             {"info", "a.h5", "--json"},
                             {"info", "--scene-keys"},
                             {"completion", "bash"},
                             {"compare", "a.h5", "a.h5"},
                             {"compare", "a.h5", "a.h5", "--json"},
                             {"record", "--list"},
                             {"render", "a.h5"},
                             {"stroke", "info", "line.toml"}}) {
    Conditions full;
    full.out = "/dev/full";
    const ProgramResult result = run_program(words, folder, full);
    EXPECT_EQ(result.exit_code, 4) << words[0];
    EXPECT_EQ(result.err,
              "sandstroke: standard output: cannot be written (No space left on device); free disk space, or "
              "redirect it\n")
        << words[0];
  }
}

TEST(CliOutput, ASmallStackIsAnErrorAtTheStart) {
  const fs::path folder = test_folder();
  const auto with_stack = [&](rlim_t kilobytes) {
    Conditions small;
    small.in_child = [kilobytes] {
      const rlimit limit{kilobytes * 1024, kilobytes * 1024};
      setrlimit(RLIMIT_STACK, &limit);
    };
    return run_program({"run", "scene.toml", "-o", "a.h5", "--png", "a.png"}, folder, small);
  };
  const ProgramResult refused = with_stack(128);
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_EQ(refused.err,
            "sandstroke: the stack is limited to 128 kB, which is too small; allow 512 kB (ulimit -s)\n");
  EXPECT_EQ(with_stack(512).exit_code, 0);
}

}  // namespace
}  // namespace sandstroke
