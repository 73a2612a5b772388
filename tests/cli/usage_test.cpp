// Command lines that are wrong, or read wrongly: what is said of them.
#include <gtest/gtest.h>

#include "cli/program.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Exit code 2, and this on standard error alone.
void expect_refused(const Words& words, const fs::path& folder, const std::string& sentence) {
  const ProgramResult result = run_program(words, folder);
  EXPECT_EQ(result.exit_code, 2) << sentence;
  EXPECT_EQ(result.out, "") << sentence;
  EXPECT_EQ(result.err, "sandstroke: " + sentence + "\n");
}

TEST(CliUsage, AnOptionThatRepeatsTakesOneValueEachTime) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program(
      {"run", "--set", "relaxation.talus_angle=32", "--set", "tool.radius=0.011", "scene.toml", "-o", "a.h5"},
      folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  expect_refused({"run", "scene.toml", "--set", "tool.radius=0.011", "b.toml"}, folder,
                 "b.toml: run takes no more arguments; see: sandstroke run --help");
  expect_refused({"bench", "--scene", "cone", "x"}, folder,
                 "x: bench takes no more arguments; see: sandstroke bench --help");
}

TEST(CliUsage, AWordThatIsNoCommandIsNamed) {
  const fs::path folder = test_folder();
  const std::string run = "rum is not a command; did you mean run?";
  expect_refused({"rum", "scene.toml"}, folder, run);
  expect_refused({"-q", "rum"}, folder, run);
  expect_refused({"rum", "--help"}, folder, run);
  expect_refused({"stroke", "conver", "a", "b"}, folder,
                 "conver is not a command of stroke; did you mean convert?");
  expect_refused({"golden", "chekc"}, folder, "chekc is not a command of golden; did you mean check?");
  expect_refused({"golden", "chekc", "--help"}, folder,
                 "chekc is not a command of golden; did you mean check?");
  expect_refused({"strawberries"}, folder, "strawberries is not a command; see: sandstroke --help");
  expect_refused({}, folder, "a command is missing; see: sandstroke --help");
  expect_refused({"stroke"}, folder, "a command is missing; see: sandstroke stroke --help");
}

TEST(CliUsage, AnOptionThatIsNoneIsNamed) {
  const fs::path folder = test_folder();
  const std::string output = "--outptu is not an option of run; did you mean --output?";
  expect_refused({"run", "scene.toml", "--outptu", "x.h5"}, folder, output);
  expect_refused({"run", "--outptu=x.h5"}, folder, output);
  expect_refused({"stroke", "convert", "--possition", "x,y"}, folder,
                 "--possition is not an option of stroke convert; did you mean --position?");
  expect_refused({"--quite", "run", "scene.toml"}, folder,
                 "--quite is not an option of run; did you mean --quiet?");
  expect_refused({"--quite"}, folder, "--quite is not an option of sandstroke; did you mean --quiet?");
  expect_refused({"run", "scene.toml", "--strawberries"}, folder,
                 "--strawberries is not an option of run; see: sandstroke run --help");
  expect_refused({"run", "scene.toml", "-x"}, folder,
                 "-x is not an option of run; see: sandstroke run --help");
}

TEST(CliUsage, EverySentenceNamesTheHelpOfItsCommand) {
  const fs::path folder = test_folder();
  for (const auto& [words, command] :
       std::vector<std::pair<Words, std::string>>{{{"run"}, "run"},
                                                  {{"run", "scene.toml", "--threads", "-1"}, "run"},
                                                  {{"golden", "update"}, "golden update"}}) {
    const ProgramResult result = run_program(words, folder);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(result.err.starts_with("sandstroke: ")) << result.err;
    EXPECT_TRUE(result.err.ends_with("; see: sandstroke " + command + " --help\n")) << result.err;
  }
}

TEST(CliUsage, OptionsThatWouldChangeNothingInAPictureAreRefused) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  const auto refused = [&](Words more, const std::string& sentence) {
    more.insert(more.begin(), {"render", "a.h5", "-o", "a.png"});
    expect_refused(more, folder, sentence);
    EXPECT_FALSE(fs::exists(folder / "a.png"));
  };
  refused({"--target", "0,0,0"}, "--target needs --view custom; the view is overview");
  refused({"--target", "0,0,0", "--view", "stroke"}, "--target needs --view custom; the view is stroke");
  for (const std::string option : {"--azimuth", "--elevation", "--distance"})
    refused({option, "1", "--view", "top"},
            option + " needs --view overview, stroke or custom; the view is top");
  refused({"--contour", "0.01"},
          "--contour needs --style height or difference; the style sand draws no contour lines");

  const ProgramResult aimed =
      run_program({"render", "--target", "0,0,0", "--view", "custom", "--azimuth", "10", "--elevation", "30",
                   "--distance", "0.4", "--style", "height", "--contour", "0.001", "a.h5", "-o", "a.png"},
                  folder);
  EXPECT_EQ(aimed.exit_code, 0) << aimed.err;
}

TEST(CliUsage, FramesThatAreNotThereAreSaidToBeNone) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "none.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "six.h5", "--frames", "4"}, folder).exit_code, 0);
  for (const std::string frame : {"3", "all"})
    expect_refused({"render", "none.h5", "--frame", frame}, folder,
                   "none.h5: has no frames; run the scene again with --frames HZ");
  for (const std::string frame : {"6", "-1"})
    expect_refused({"render", "six.h5", "--frame", frame}, folder,
                   "six.h5: has no frame " + frame + "; take 0 to 5");
  expect_refused({"render", "none.h5", "--video", "v.avi"}, folder,
                 "v.avi: is not the name of a film; end it with .mp4, .webm, .gif");
}

}  // namespace
}  // namespace sandstroke
