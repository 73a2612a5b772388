// The programs that people have open what is written.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "cli/program.h"
#include "io/png_file.h"
#include "io/run_file.h"
#include "real_client.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The output of a script of tests/clients, a line of JSON each.
std::vector<Json> said_by(std::vector<std::string> words) {
  for (std::string& word : words)
    if (word.ends_with(".py")) word = std::string(SANDSTROKE_SOURCE) + "/tests/clients/" + word;
  const auto result = run_child(words);
  EXPECT_TRUE(result && result->exit_code == 0) << (result ? result->err : "there is no " + words.front());
  std::vector<Json> lines;
  std::istringstream text(result ? result->out : "");
  for (std::string line; std::getline(text, line);)
    if (line.starts_with("{")) lines.push_back(Json::parse(line));
  return lines;
}

class CliClients : public testing::Test {
  void SetUp() override {
    if (sanitized) GTEST_SKIP() << "no sanitizer sees what other programs do";
  }
};

/// A run with frames, of a bed whose sand is not level.
fs::path folder_with_rippled_run() {
  const fs::path folder = test_folder();
  const ProgramResult run = run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "20", "--set",
                                         "bed.surface={ kind = 'ripples', amplitude = 0.002 }"},
                                        folder);
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return folder;
}

void expect_described(const Json& group, const std::string& name, const Json& dims,
                      const std::string& units) {
  ASSERT_TRUE(group["variables"].contains(name)) << name << ": " << group.dump();
  const Json& variable = group["variables"][name];
  EXPECT_EQ(variable["dims"], dims) << name;
  EXPECT_FALSE(variable["attrs"].value("long_name", "").empty()) << name;
  EXPECT_EQ(variable["attrs"].value("units", ""), units) << name;
}

TEST_F(CliClients, XarrayAndH5pyOpenARunWithItsAxes) {
  SANDSTROKE_NEEDS(python_has("xarray, h5netcdf"), "python3-xarray or python3-h5netcdf");
  const fs::path folder = folder_with_rippled_run();
  const std::vector<Json> groups = said_by({python, "xarray_opens.py", (folder / "a.h5").string(), "surface",
                                            "trace", "relaxation", "provenance"});
  ASSERT_EQ(groups.size(), 4u);
  const RunFile run(folder / "a.h5");
  const Json bed = {"y", "x"}, over_time = {"time"}, vectors = {"time", "axis"};
  const Json& surface = groups[0];
  expect_described(surface, "initial", bed, "m");
  expect_described(surface, "final", bed, "m");
  expect_described(surface, "frames", {"time", "y", "x"}, "m");
  for (const char* axis : {"x", "y"}) expect_described(surface, axis, {axis}, "m");
  expect_described(surface, "time", over_time, "s");
  const BedGeometry geometry(run.rows(), run.cols(), run.cell_size());
  EXPECT_EQ(surface["variables"]["x"]["least"], geometry.x_of(0));
  EXPECT_EQ(surface["variables"]["y"]["greatest"], geometry.y_of(run.rows() - 1));
  EXPECT_EQ(surface["variables"]["final"]["least"], run.final().minCoeff());

  visit_tick_fields([&](const FieldText& field, const auto& of) {
    using Value = std::decay_t<decltype(of(std::declval<TickRecord&>()))>;
    if (field.only_with) return;  // this run has neither recorded forces nor dropped ticks
    expect_described(groups[1], field.name, std::is_same_v<Value, Eigen::Vector3d> ? vectors : over_time,
                     field.units);
  });
  EXPECT_EQ(groups[1]["variables"]["contact"]["kind"], "b");  // bool
  expect_described(groups[2], "passes", over_time, "1");
  EXPECT_EQ(groups[2]["variables"]["passes"]["kind"], "i");
  for (const auto& [name, value] : run.provenance()) EXPECT_EQ(groups[3]["attrs"][name], value) << name;
}

TEST_F(CliClients, XarrayOpensStrokes) {
  SANDSTROKE_NEEDS(python_has("xarray, h5netcdf"), "python3-xarray or python3-h5netcdf");
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"stroke", "script", "line.toml", "made.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"record", "--max-skipped", "100", "-o", "hand.h5", "--device", "scripted:line.toml"},
                        folder)
                .exit_code,
            0);
  for (const char* name : {"made.h5", "hand.h5"}) {
    const std::vector<Json> groups = said_by({python, "xarray_opens.py", (folder / name).string(), "stroke"});
    ASSERT_EQ(groups.size(), 1u) << name;
    expect_described(groups[0], "time", {"time"}, "s");
    expect_described(groups[0], "position", {"time", "axis"}, "m");
    EXPECT_EQ(groups[0]["attrs"]["complete"], "1") << name;
  }
}

TEST_F(CliClients, ParaViewOpensARunWithEachOfItsReadersAndWarpsIt) {
  SANDSTROKE_NEEDS(python_has("paraview.simple"), "python3-paraview");
  SANDSTROKE_NEEDS(run_child({"xvfb-run", "--help"}), "xvfb");
  const fs::path folder = folder_with_rippled_run();
  const RunFile run(folder / "a.h5");
  const BedGeometry bed(run.rows(), run.cols(), run.cell_size());
  const std::string xdmf = fs::absolute(folder / "a.xdmf").string(),
                    picture = (folder / "warped.png").string();
  std::vector<double> times = run.frame_times();
  times.push_back(run.trace().back().time);
  for (const std::string reader : {"default", "XDMFReader", "Xdmf3ReaderT"}) {
    std::vector<std::string> words = {python, "paraview_opens.py", reader, xdmf};
    if (reader == "default") {
      words.insert(words.begin(), {"xvfb-run", "-a", "-s", "-noreset"});  // ParaView comes more than once
      words.push_back(picture);
    }
    const std::vector<Json> said = said_by(words);
    ASSERT_EQ(said.size(), 1u) << reader;
    const Json& steps = said[0]["steps"];
    ASSERT_EQ(steps.size(), times.size()) << reader;
    RunFrames frames(run);
    for (std::size_t k = 0; k < steps.size(); ++k) {
      const bool is_last = k + 1 == steps.size();
      const HeightGrid heights = is_last ? run.final() : frames.surface(static_cast<int>(k)).grid();
      EXPECT_NEAR(steps[k]["time"].get<double>(), times[k], 1.1e-3) << reader;  // its end is a tick later
      EXPECT_EQ(steps[k]["low"], heights.minCoeff()) << reader << k;
      EXPECT_EQ(steps[k]["high"], heights.maxCoeff()) << reader << k;
      const std::vector<double> bounds = steps[k]["bounds"];
      const double expected[] = {
          bed.x_of(0), bed.x_of(bed.cols() - 1), bed.y_of(0), bed.y_of(bed.rows() - 1), 0, 0};
      for (int i = 0; i < 6; ++i) EXPECT_NEAR(bounds[i], expected[i], 1e-12) << reader << i;
    }
  }
  const Image warped = read_png(picture);
  std::set<std::array<std::uint8_t, 3>> colours;  // of a flat grid there would be but one beside the black
  for (std::size_t i = 0; i + 2 < warped.rgb.size(); i += 3)
    colours.insert({warped.rgb[i], warped.rgb[i + 1], warped.rgb[i + 2]});
  EXPECT_GT(colours.size(), 200u);
}

}  // namespace
}  // namespace sandstroke
