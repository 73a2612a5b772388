#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>

#include "cli/program.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// A file that `stroke convert` refuses until the user gives what its sentences ask for.
struct RefusedFile {
  const char *name, *text, *second;           // second: second.csv beside it, or empty
  std::vector<std::string> given;             // options from the start
  std::map<std::string, std::string> answer;  // the value that a user gives for an option
};

const std::vector<RefusedFile> refused_files = {
    {"units.csv", "t,x,y\n0,1,2\n10,3,4\n", "", {}, {{"--position-unit", "mm"}, {"--time-unit", "ms"}}},
    {"pixels.csv", "t_s,x_px,y_px\n0,1,2\n1,3,4\n", "", {}, {{"--pixel-size", "0.001"}}},
    {"odd_unit.csv", "t_s,x [furlong],y [furlong]\n0,1,2\n1,3,4\n", "", {}, {{"--position-unit", "201.168"}}},
    {"odd_time.csv", "t [fortnight],x_m,y_m\n0,1,2\n1,3,4\n", "", {}, {{"--time-unit", "s"}}},
    {"no_times.csv", "x_m,y_m\n1,2\n3,4\n", "", {}, {{"--rate", "10"}}},
    {"no_names.csv",
     "a,b\n1,2\n3,4\n",
     "",
     {"--rate", "10"},
     {{"--position", "a,b"}, {"--position-unit", "m"}}},
    {"equal.csv", "t_s,x_m,y_m\n0,1,2\n0,3,4\n1,5,6\n", "", {}, {{"--equal-times", "spread"}}},
    {"all_equal.csv", "t_s,x_m,y_m\n0,1,2\n0,3,4\n", "", {"--equal-times", "spread"}, {{"--rate", "10"}}},
    {"force.csv",
     "t_s,x_m,y_m,fx,fy\n0,1,2,3,4\n1,5,6,7,8\n",
     "",
     {"--force", "fx,fy"},
     {{"--force-unit", "N"}}},
    {"velocity.csv",
     "t_s,x_m,y_m,vx,vy\n0,1,2,3,4\n1,5,6,7,8\n",
     "",
     {"--velocity", "vx,vy"},
     {{"--velocity-unit", "m/s"}}},
    {"pattern.thr", "0 0\n1 0.5\n2 1\n", "", {}, {{"--position-unit", "0.2"}, {"--speed", "0.1"}}},
    {"wrench.csv",
     "t_s,x_m,y_m\n0,1,2\n1,5,6\n",
     "t,wrench.force.x,wrench.force.y,wrench.force.z\n0,1,2,3\n1000,4,5,6\n",
     {"--merge", "second.csv"},
     {{"--force-unit", "N"}, {"--merge-time-unit", "ms"}}},
    {"clock.csv",
     "stamp,x_m,y_m\n1700000000000,1,2\n1700000001000,5,6\n",
     "t_s,fx_N,fy_N\n7,1,2\n9,4,5\n",
     {"--merge", "second.csv"},
     {{"--merge-shift", "-7.5"}}},
    {"force_by_another_name.csv",
     "t_s,x_m,y_m\n0,1,2\n1,5,6\n",
     "t_s,a,b\n0,1,2\n1,4,5\n",
     {"--merge", "second.csv"},
     {{"--force", "a,b"}, {"--force-unit", "N"}}},
};

class CliWayOut : public testing::TestWithParam<RefusedFile> {};

/// Whoever gives each option that a sentence asks for, gets a stroke.
TEST_P(CliWayOut, Works) {
  const RefusedFile& file = GetParam();
  const fs::path folder = test_folder();
  write_file(folder / file.name, file.text);
  if (*file.second) write_file(folder / "second.csv", file.second);
  std::vector<std::string> given = file.given, taken;
  for (std::size_t round = 0; round <= file.answer.size(); ++round) {
    std::vector<std::string> arguments = {"stroke", "convert", file.name, "out.h5"};
    arguments.insert(arguments.end(), given.begin(), given.end());
    arguments.insert(arguments.end(), taken.begin(), taken.end());
    const ProgramResult result = run_program(arguments, folder);
    if (result.exit_code == 0) {
      EXPECT_GT(round, 0u) << "it was not refused";
      return;
    }
    ASSERT_EQ(result.exit_code, 2) << result.err;
    const bool names_first = result.err.find(file.name) != std::string::npos;
    const bool names_second = *file.second && result.err.find("second.csv") != std::string::npos;
    EXPECT_TRUE(names_first || names_second) << "it names no file: " << result.err;
    const std::size_t before = taken.size();
    const std::regex option("\\(stroke convert: (--[a-z-]+)\\)");
    for (std::sregex_iterator at(result.err.begin(), result.err.end(), option), end; at != end; ++at)
      if (const auto answer = file.answer.find((*at)[1]);
          answer != file.answer.end() && std::find(taken.begin(), taken.end(), answer->first) == taken.end())
        taken.insert(taken.end(), {answer->first, answer->second});
    ASSERT_GT(taken.size(), before) << "no way out is told: " << result.err;
    if (file.name == std::string("all_equal.csv")) given.clear();  // "instead"
  }
  FAIL() << "all options that were asked for are given, and it is refused still";
}

INSTANTIATE_TEST_SUITE_P(, CliWayOut, testing::ValuesIn(refused_files), [](const auto& info) {
  std::string name = info.param.name;
  return std::regex_replace(name, std::regex("[^a-z]"), "");
});

}  // namespace
}  // namespace sandstroke
