#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

TEST(CliBench, LeavesItsPageAndSaysWhere) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"bench", "--quick", "--scene", "plunge", "--repeats", "1", "-o", "out"}, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* name : {"bench.html", "bench.csv", "bench.h5"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
  EXPECT_NE(run.out.find("out/bench.html"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("Orders of convergence"), std::string::npos) << run.out;
}

TEST(CliBench, PrintsThePagesDataAsJson) {
  const fs::path folder = test_folder();
  const ProgramResult run =
      run_program({"bench", "--quick", "--scene", "drag", "--repeats", "1", "--json"}, folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["problems"][0]["name"], "drag");
  EXPECT_TRUE(fs::exists(folder / "bench/bench.html"));  // where no folder is named
}

TEST(CliBench, RefusesWhatIsNotThereOrCannotBeWritten) {
  const fs::path folder = test_folder();
  const ProgramResult unknown = run_program({"bench", "--quick", "--scene", "castle"}, folder);
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("castle"), std::string::npos) << unknown.err;
  write_file(folder / "file", "text");
  const ProgramResult place = run_program({"bench", "--quick", "-o", "file"}, folder);
  EXPECT_EQ(place.exit_code, 4);
  EXPECT_NE(place.err.find("file"), std::string::npos) << place.err;
}

TEST(CliBench, StoppedBySignalItLeavesNothing) {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"bench", "-o", "out"}, folder, {SIGINT, 1500});
  EXPECT_EQ(run.exit_code, 130) << run.err;
  EXPECT_TRUE(!fs::exists(folder / "out") || fs::is_empty(folder / "out"));
}

}  // namespace
}  // namespace sandstroke
