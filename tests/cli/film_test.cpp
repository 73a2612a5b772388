#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/program.h"
#include "core/child_process.h"
#include "io/png_file.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// A run with frames, a.h5, and a place for programs that are found instead of all others.
class CliFilm : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "4"}, folder_).exit_code, 0);
    fs::create_directory(folder_ / "programs");
  }

  /// A program of this name, in place of the real one, that does this; $output is the file that it is to
  /// write.
  void fake_ffmpeg(const std::string& script) {
    const fs::path program = folder_ / "programs/ffmpeg";
    write_file(
        program,
        "#!/bin/sh\nPATH=/usr/bin:/bin\necho \"$*\" > words\nfor last; do :; done\noutput=${last#file:}\n" +
            script + "\n");
    fs::permissions(program, fs::perms::owner_all);
  }
  ProgramResult film(const std::vector<std::string>& more = {}, Conditions conditions = {}) {
    std::vector<std::string> words = {"render", "a.h5", "--frame", "all", "--video", "a.mp4"};
    words.insert(words.end(), more.begin(), more.end());
    conditions.path = (folder_ / "programs").string();
    return run_program(words, folder_, conditions);
  }
  /// Names of the files that are there now and begin so.
  std::vector<std::string> files(const std::string& begin) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
      if (entry.path().filename().string().starts_with(begin)) names.push_back(entry.path().filename());
    return names;
  }
  void expect_failure(const ProgramResult& result, const std::string& sentence) {
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
    EXPECT_TRUE(files("a.mp4").empty());
  }

  const fs::path folder_ = test_folder();
};

TEST_F(CliFilm, FfmpegIsFedThePicturesOfAllFrames) {
  fake_ffmpeg("cat > \"$output\"");
  const ProgramResult result = film();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "a.mp4\n");
  EXPECT_NE(result.err.find("4 per second: as fast as the stroke"), std::string::npos) << result.err;
  EXPECT_NE(read_file(folder_ / "words").find("-video_size 320x180 -framerate 4 "), std::string::npos);
  ASSERT_EQ(run_program({"render", "a.h5", "--frame", "all", "-o", "pictures"}, folder_).exit_code, 0);
  std::string pixels;
  for (int k = 0; fs::exists(folder_ / fmt::format("pictures/frame_{:04}.png", k)); ++k) {
    const Image image = read_png(folder_ / fmt::format("pictures/frame_{:04}.png", k));
    pixels.append(image.rgb.begin(), image.rgb.end());
  }
  EXPECT_GT(pixels.size(), 0u);
  EXPECT_TRUE(read_file(folder_ / "a.mp4") == pixels);
  EXPECT_EQ(files("a.mp4").size(), 1u);
}

TEST_F(CliFilm, ARunFilmsItsFramesInTheSameCommand) {
  fake_ffmpeg("cat > \"$output\"");
  ASSERT_EQ(film().exit_code, 0);
  Conditions conditions;
  conditions.path = (folder_ / "programs").string();
  const ProgramResult result = run_program(
      {"run", "scene.toml", "-o", "b.h5", "--frames", "4", "--video", "b.mp4"}, folder_, conditions);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(read_file(folder_ / "b.mp4") == read_file(folder_ / "a.mp4"));

  const ProgramResult none = run_program({"run", "scene.toml", "-o", "c.h5", "--video", "c.mp4"}, folder_);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_NE(none.err.find("keeps none; add --frames 10"), std::string::npos) << none.err;
  EXPECT_FALSE(fs::exists(folder_ / "c.h5"));
}

TEST_F(CliFilm, HasItsOwnRateWhereOneIsGiven) {
  fake_ffmpeg("cat > \"$output\"");
  const ProgramResult result = film({"--fps", "10"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("2.5 times as fast as the stroke"), std::string::npos) << result.err;
  EXPECT_NE(read_file(folder_ / "words").find("-framerate 10 "), std::string::npos);
}

TEST_F(CliFilm, SaysWhatToInstall) { expect_failure(film(), "apt-get install ffmpeg"); }

TEST_F(CliFilm, SaysSoBeforeARunIsMade) {
  Conditions conditions;
  conditions.path = (folder_ / "programs").string();
  const ProgramResult result = run_program(
      {"run", "scene.toml", "-o", "d.h5", "--frames", "4", "--video", "d.mp4"}, folder_, conditions);
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_NE(result.err.find("apt-get install ffmpeg"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder_ / "d.h5"));
}

TEST_F(CliFilm, FfmpegsLastWordIsTheReason) {
  fake_ffmpeg("echo other >&2; echo No such encoder >&2; exit 1");
  expect_failure(film(), "a.mp4: ffmpeg cannot write it: No such encoder\n");
  fake_ffmpeg("head -c 1000 > \"$output\"; exit 7");
  expect_failure(film(), "it stopped early with exit code 7");
  fake_ffmpeg("head -c 1000 > \"$output\"");  // all well, it says
  expect_failure(film(), "it stopped early");
  fake_ffmpeg("cat > \"$output\"; echo No space left on device >&2; exit 1");
  write_file(folder_ / "a.mp4", "an older film");
  EXPECT_EQ(film().exit_code, 2);  // it may be somebody else's
  EXPECT_EQ(film({"--overwrite"}).exit_code, 4);
  EXPECT_EQ(read_file(folder_ / "a.mp4"), "an older film");
  EXPECT_EQ(files("a.mp4").size(), 1u);
}

TEST_F(CliFilm, ASignalEndsFfmpegTooAndLeavesNothing) {
  const std::string hangs = "echo $$ > pid; mv pid started; exec sleep 1000";
  for (const std::string first : {"", "cat > /dev/null; "})  // while it is fed, and while it finishes
    for (const int signal : {SIGINT, SIGTERM}) {
      fs::remove(folder_ / "started");
      fake_ffmpeg(": > \"$output\"; " + first + hangs);
      Conditions conditions;
      conditions.signal = signal;
      conditions.when = [&] { return fs::exists(folder_ / "started"); };
      const ProgramResult result = film({}, conditions);
      EXPECT_EQ(result.exit_code, 128 + signal) << result.err;
      EXPECT_TRUE(files("a.mp4").empty());
      pid_t ffmpeg = 0;
      std::ifstream(folder_ / "started") >> ffmpeg;
      ASSERT_GT(ffmpeg, 0);
      EXPECT_EQ(kill(ffmpeg, 0), -1);
    }
}

TEST_F(CliFilm, WhatCannotBeIsRefused) {
  fake_ffmpeg("cat > \"$output\"");
  const auto refused = [&](const std::vector<std::string>& words, const std::string& sentence) {
    const ProgramResult result = run_program(words, folder_, {.path = (folder_ / "programs").string()});
    EXPECT_EQ(result.exit_code, 2) << words.back();
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  };
  refused({"render", "a.h5", "--video", "a.mp4", "--size", "321x180"}, "add --size 322x180");
  refused({"render", "a.h5", "--video", "a.avi"}, "end it with .mp4, .webm, .gif");
  refused({"render", "a.h5", "--video", "a.mp4", "--frame", "2"}, "leave out --frame 2");
  refused({"render", "a.h5", "--video", "a.mp4", "-o", "pictures"}, "--output");
  refused({"render", "a.h5", "--fps", "3"}, "--video");
  refused({"render", "a.h5", "--video", "a.h5"}, "is not the name of a film; end it with");
  EXPECT_TRUE(files("a.mp4").empty());
  EXPECT_TRUE(files("a.avi").empty());
}

TEST_F(CliFilm, NamesAreNoOptionsAndNoProtocols) {
  fake_ffmpeg("cat > \"$output\"");
  for (const std::string name : {"http:x y'$(touch bad)`touch bad`;\"\n.mp4", "-y.mp4", "%d.mp4"}) {
    const ProgramResult result = run_program({"render", "a.h5", "--video=" + name}, folder_,
                                             {.path = (folder_ / "programs").string()});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(fs::exists(folder_ / name));
    EXPECT_NE(read_file(folder_ / "words").find(" file:" + name), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(folder_ / "bad"));
}

TEST_F(CliFilm, RealFfmpegMakesAFilmOrNone) {
  if (!run_child({"ffprobe", "-version"})) GTEST_SKIP() << "ffmpeg is not installed";
  for (const std::string name : {"a.mp4", "a.webm", "a.gif"}) {
    const ProgramResult made = run_program({"render", "a.h5", "--video", name}, folder_);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto probed = run_child({"ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json",
                                   (folder_ / name).string()});
    const auto stream = nlohmann::json::parse(probed->out)["streams"][0];
    EXPECT_EQ(stream["nb_read_frames"], "6") << name;
    EXPECT_EQ(stream["r_frame_rate"], "4/1") << name;
    EXPECT_EQ(stream["width"], 320);
    EXPECT_EQ(stream["height"], 180);
    const std::size_t bytes = fs::file_size(folder_ / name);
    fs::remove(folder_ / name);
    if (threads_sanitized) continue;  // its own memory is a file
    const ProgramResult full =
        run_program({"render", "a.h5", "--video", name}, folder_, {.most_file_bytes = bytes - 1});
    EXPECT_EQ(full.exit_code, 4) << name;
    EXPECT_NE(full.err.find("ffmpeg cannot write it: "), std::string::npos) << full.err;
    EXPECT_TRUE(files(name).empty());
  }
}

}  // namespace
}  // namespace sandstroke
