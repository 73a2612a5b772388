#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "cli/program.h"
#include "io/run_file.h"
#include "io/stroke_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The forces of a run, as a recording of it.
void write_felt_stroke(const fs::path& run, const fs::path& stroke, double sign = 1.0) {
  Stroke felt;
  for (const TickRecord& tick : RunFile(run).trace()) {
    felt.time.push_back(tick.time);
    felt.position.push_back(tick.hand.position);
    felt.force.push_back(sign * tick.device_force);
  }
  write_stroke_file(stroke, felt);
}

TEST(CliFit, FindsTheConstantsOfARunFromWhatItFelt) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "--set", "force.k_s=400", "--set", "force.k_f=6", "-o", "a.h5"},
                        folder)
                .exit_code,
            0);
  write_felt_stroke(folder / "a.h5", folder / "felt.h5");
  const ProgramResult found = run_program({"fit", "scene.toml", "--stroke", "felt.h5", "--json"}, folder);
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const Json fit = Json::parse(found.out);
  EXPECT_NEAR(fit["stiffness"], 200.0, 2.0);
  EXPECT_NEAR(fit["k_f"]["value"], 6.0, 0.3);
  EXPECT_GT(fit["explained"], 0.99);
  EXPECT_EQ(fit["k_f"]["determined"], true);
  EXPECT_LT(fit["residual_rms"], fit["scene_residual_rms"]);
  EXPECT_EQ(found.err.find("warning"), std::string::npos) << found.err;
  const ProgramResult table = run_program({"fit", "scene.toml", "--stroke", "felt.h5"}, folder);
  EXPECT_NE(table.out.find("--set force.k_s="), std::string::npos) << table.out;
}

TEST(CliFit, SaysWhenTheModelCannotExplainTheForceOrItsSignIsTheOther) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  write_felt_stroke(folder / "a.h5", folder / "turned.h5", -1.0);
  const ProgramResult turned = run_program({"fit", "scene.toml", "--stroke", "turned.h5"}, folder);
  EXPECT_EQ(turned.exit_code, 0);
  EXPECT_NE(turned.err.find("the other --force-sign"), std::string::npos) << turned.err;
  Stroke odd = read_stroke_file(folder / "turned.h5");
  for (std::size_t i = 0; i < odd.size(); ++i) odd.force[i] = {i % 2 == 0 ? 3.0 : -3.0, 0.0, 0.0};
  write_stroke_file(folder / "odd.h5", odd);
  const ProgramResult result = run_program({"fit", "scene.toml", "--stroke", "odd.h5"}, folder);
  EXPECT_NE(result.err.find("cannot explain"), std::string::npos) << result.err;
}

/// In shallow sand the force is k_s k_c d to one in a hundred, so that only the product is known.
TEST(CliFit, TellsTheProductWhereTheConstantsAreNotDetermined) {
  const fs::path folder = test_folder();
  const std::vector<std::string> settings = {"--set", "force.k_s=800", "--set", "force.k_c=0.7"};
  std::vector<std::string> run = {"run", "scene.toml", "-o", "a.h5"};
  run.insert(run.end(), settings.begin(), settings.end());
  ASSERT_EQ(run_program(run, folder).exit_code, 0);
  write_felt_stroke(folder / "a.h5", folder / "felt.h5");
  Stroke noisy = read_stroke_file(folder / "felt.h5");
  std::mt19937 random(1);
  std::normal_distribution<double> error(0.0, 0.05);
  for (Eigen::Vector3d& force : noisy.force)
    for (double& component : force) component += error(random);
  write_stroke_file(folder / "noisy.h5", noisy);
  const std::vector<std::string> fit_noisy = {"fit", "scene.toml", "--stroke", "noisy.h5"};
  std::vector<std::string> for_machines = fit_noisy;
  for_machines.emplace_back("--json");
  const ProgramResult found = run_program(for_machines, folder);
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const Json fit = Json::parse(found.out);
  EXPECT_EQ(fit["k_c"]["determined"], false);
  EXPECT_EQ(fit["k_c"]["kept"], true);
  EXPECT_EQ(fit["k_c"]["value"], 0.5);  // the scene's
  EXPECT_TRUE(fit["k_c"]["error"].is_null());
  EXPECT_LE(fit["k_c"]["interval_95"][0], 0.7);
  EXPECT_EQ(fit["k_s"]["determined"], false);
  EXPECT_NEAR(fit["k_s"]["value"], 560.0 / 0.5, 20.0);
  EXPECT_NEAR(fit["stiffness"], 560.0, 4.0 * static_cast<double>(fit["stiffness_error"]));
  EXPECT_LT(fit["stiffness_error"], 10.0);
  const ProgramResult table = run_program(fit_noisy, folder);
  EXPECT_NE(table.out.find("given k_c = 0.5 1/m"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find("what is left       differs from one tick to the next"), std::string::npos)
      << table.out;
}

const std::vector<std::string> rft = {"--set", "force.law=rft", "--set", "tool.profile=sphere"};

ProgramResult run_with(std::vector<std::string> arguments, const std::vector<std::string>& settings,
                       const fs::path& folder) {
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  return run_program(arguments, folder);
}

TEST(CliFit, FindsTheSandOfTheOtherLaws) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_with({"run", "scene.toml", "--set", "force.friction_angle=37", "--set",
                      "force.tool_friction=0.2", "-o", "a.h5"},
                     rft, folder)
                .exit_code,
            0);
  write_felt_stroke(folder / "a.h5", folder / "felt.h5");
  const ProgramResult found = run_with({"fit", "scene.toml", "--stroke", "felt.h5", "--json"}, rft, folder);
  ASSERT_EQ(found.exit_code, 0) << found.err;
  const Json fit = Json::parse(found.out);
  EXPECT_NEAR(fit["friction_angle"]["value"], 37.0, 0.01);
  EXPECT_NEAR(fit["tool_friction"]["value"], 0.2, 0.002);
  EXPECT_EQ(fit["tool_friction"]["key"], "force.tool_friction");
  EXPECT_EQ(fit["tool_friction"]["determined"], true);
  EXPECT_FALSE(fit.contains("yield"));
  EXPECT_GT(fit["explained"], 0.999);
  const ProgramResult table = run_with({"fit", "scene.toml", "--stroke", "felt.h5"}, rft, folder);
  EXPECT_NE(table.out.find("sandstroke run SCENE --set force.law=rft"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find(" --set force.friction_angle=37"), std::string::npos) << table.out;
  EXPECT_NE(table.out.find(" --set force.tool_friction=0."), std::string::npos) << table.out;
  EXPECT_EQ(table.err.find("warning"), std::string::npos) << table.err;
  // The same force, as another law sees it: most of it is lift.
  const ProgramResult lift = run_program(
      {"fit", "scene.toml", "--stroke", "felt.h5", "--set", "force.law=archimedes", "--json"}, folder);
  ASSERT_EQ(lift.exit_code, 0) << lift.err;
  EXPECT_GT(Json::parse(lift.out)["friction_angle"]["value"], 20.0);
}

TEST(CliFit, SaysThatNoSceneCanHaveTheSandThatAForceAsksFor) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_with({"run", "scene.toml", "-o", "a.h5"}, rft, folder).exit_code, 0);
  write_felt_stroke(folder / "a.h5", folder / "milli.h5", 1000.0);
  const ProgramResult result =
      run_with({"fit", "scene.toml", "--stroke", "milli.h5", "--set", "device.max_force=0"}, rft, folder);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("no scene can have these constants"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("friction_angle"), std::string::npos) << result.err;
  EXPECT_EQ(result.out.find("to use it"), std::string::npos) << result.out;
}

TEST(CliFit, RefusesInASentence) {
  const fs::path folder = test_folder();
  const auto refusal = [&](const std::vector<std::string>& arguments) {
    const ProgramResult result = run_program(arguments, folder);
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_NE(refusal({"fit", "scene.toml"}).find("has no forces"), std::string::npos);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  write_felt_stroke(folder / "a.h5", folder / "felt.h5");
  EXPECT_NE(refusal({"fit", "scene.toml", "--stroke", "felt.h5", "--constants", "k_x"}).find("k_s, k_c, k_f"),
            std::string::npos);
  EXPECT_NE(refusal({"fit", "scene.toml", "--stroke", "felt.h5", "--set", "force.law=archimedes",
                     "--constants", "k_s"})
                .find("choose from friction_angle, yield"),
            std::string::npos);
  EXPECT_NE(refusal({"fit", "scene.toml", "--stroke", "felt.h5", "--set", "stroke.offset=[0, 0, 1]"})
                .find("have both contact with sand and a recorded force"),
            std::string::npos);
}

}  // namespace
}  // namespace sandstroke
