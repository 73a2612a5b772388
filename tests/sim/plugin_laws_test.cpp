#include "sim/plugin_laws.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "sand/sphere_tool.h"
#include "sim/sand_watch.h"
#include "sim/simulation.h"
#include "tool/tool_surface.h"

namespace sandstroke {
namespace {

using Eigen::Vector3d;

/// The message of the Error from work that has to fail.
template <class Work>
std::string refusal_of(const Work& work, ErrorKind kind = ErrorKind::input) {
  try {
    work();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "nothing was refused";
}

bool says(const std::string& sentence, const std::string& part) {
  return sentence.find(part) != std::string::npos;
}

/// The program's law, as a plugin law.
class BorrowedLaw : public Relaxer {
 public:
  BorrowedLaw(const RelaxationSettings& settings, double cell_size)
      : relaxer_(make_relaxer(settings, cell_size)) {}
  RelaxationOutcome relax(HeightField& bed, const PassWatcher& after_pass) override {
    return relaxer_->relax(bed, after_pass);
  }

 private:
  std::unique_ptr<Relaxer> relaxer_;
};

class BorrowedRule : public Displacer {
 public:
  explicit BorrowedRule(const Scene& scene) : tool_(scene.tool), settings_(scene.displacement) {}
  double displace(HeightField& bed, const Tool& tool, double tip_height, const Vector3d& motion) override {
    tool_.place(bed, tool.footprint().axis_x() * bed.cell_size(),
                tool.footprint().axis_y() * bed.cell_size());
    return tool_.displace(bed, tip_height, motion, settings_);
  }

 private:
  SphereTool tool_;
  DisplacementSettings settings_;
};

/// Keeps all that it receives.
struct Heard {
  int felt = 0, lifted = 0;
  double deepest = 0.0;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Zero();
};
class ForceThatHears : public ToolForce {
 public:
  ForceThatHears(Heard& heard, const Wrench& wrench) : heard_(heard), wrench_(wrench) {}
  Wrench feel(const ToolInSand& touch) override {
    ++heard_.felt;
    heard_.deepest = std::max(heard_.deepest, touch.depth);
    return wrench_;
  }
  void lift() override { ++heard_.lifted; }
  void turn(const Eigen::Matrix3d& rotation) override { heard_.rotation = rotation; }

 private:
  Heard& heard_;
  Wrench wrench_;
};

Scene scene_with_laws(const PluginLaws& laws) {
  Scene scene;
  scene.bed.width = scene.bed.depth = 0.12;
  scene.bed.cols = scene.bed.rows = 60;
  scene.plugin_laws.laws = std::make_shared<PluginLaws>(laws);
  return scene;
}

/// A stroke down, through the sand, and up.
Stroke down_and_along() {
  Stroke stroke;
  stroke.gap_threshold = 1.0;
  stroke.time = {0.0, 0.1, 0.3, 0.4};
  stroke.position = {{-0.02, 0.0, 0.005}, {-0.02, 0.0, -0.005}, {0.02, 0.004, -0.005}, {0.02, 0.004, 0.005}};
  return stroke;
}

struct EndOfRun {
  HeightGrid heights;
  RunResult result;
};
EndOfRun run_drag(const Scene& scene) {
  Simulation simulation(scene, starting_bed(scene.bed), down_and_along());
  const RunResult result = simulation.run();
  return {simulation.bed().grid(), result};
}

TEST(PluginLaws, TheProgramsOwnLawsUnderAnotherNameGiveTheSameBits) {
  PluginLaws laws;
  laws.relaxations["borrowed"] = [](const Scene& scene, double cell_size) {
    return std::make_unique<BorrowedLaw>(scene.relaxation, cell_size);
  };
  laws.displacements["borrowed"] = [](const Scene& scene, double) {
    return std::make_unique<BorrowedRule>(scene);
  };
  for (const ModelPreset preset : {ModelPreset::paper, ModelPreset::accurate}) {
    Scene scene = scene_with_laws(laws);
    scene.preset = preset;
    apply_model_preset(scene);
    const EndOfRun theirs = run_drag(scene);
    scene.plugin_laws.relaxation = scene.plugin_laws.displacement = "borrowed";
    const EndOfRun own = run_drag(scene);
    EXPECT_TRUE((own.heights == theirs.heights).all());
    EXPECT_EQ(own.result.moved_volume, theirs.result.moved_volume);
    EXPECT_EQ(own.result.device.absorbed_energy, theirs.result.device.absorbed_energy);
  }
}

TEST(PluginLaws, AForceIsToldOfEachTickInContactAndGivesTheDeviceItsOwn) {
  Heard heard;
  Wrench wrench;
  wrench.force = {3.0, 0.0, 4.0};
  PluginLaws laws;
  laws.forces["constant"] = [&](const Scene&, double) {
    return std::make_unique<ForceThatHears>(heard, wrench);
  };
  Scene scene = scene_with_laws(laws);
  scene.plugin_laws.force = "constant";
  scene.device.max_force = 0.0;
  const RunResult unlimited = run_drag(scene).result;
  EXPECT_EQ(heard.felt, unlimited.contact_ticks);
  EXPECT_GE(heard.lifted, unlimited.ticks - unlimited.contact_ticks);
  EXPECT_EQ(heard.deepest, unlimited.max_depth);
  EXPECT_TRUE(heard.rotation.isApprox(own_rotation(scene.tool)));
  EXPECT_DOUBLE_EQ(unlimited.device.max_force, 5.0);
  scene.device.max_force = 2.5;  // and its strength, which the law does not say, is no less than its force
  EXPECT_DOUBLE_EQ(run_drag(scene).result.device.max_force, 2.5);
}

TEST(PluginLaws, MakersAreGivenTheSceneAndTheBedsCells) {
  PluginLaws laws;
  Scene seen;
  double cell = 0.0;
  laws.relaxations["borrowed"] = [&](const Scene& scene, double cell_size) {
    seen = scene;
    cell = cell_size;
    return std::make_unique<BorrowedLaw>(scene.relaxation, cell_size);
  };
  Scene scene = scene_with_laws(laws);
  scene.plugin_laws.relaxation = "borrowed";
  scene.plugin_laws.parameters = {1.0, 2.0, 3.0, 4.0};
  scene.relaxation.talus_angle = 41.0;
  Simulation(scene, HeightField(10, 10, 0.5), std::nullopt);
  EXPECT_EQ(cell, 0.5);
  EXPECT_EQ(seen.plugin_laws.parameters, scene.plugin_laws.parameters);
  EXPECT_EQ(seen.relaxation.talus_angle, 41.0);
}

TEST(PluginLaws, ANameThatIsNotThereIsRefusedWithThoseThatAre) {
  Scene scene = scene_with_laws({});
  const auto begin = [&] { Simulation(scene, starting_bed(scene.bed), down_and_along()); };
  scene.plugin_laws.plugin = "laws.so";
  scene.plugin_laws.relaxation = "slow";
  EXPECT_EQ(refusal_of(begin),
            "laws.so: has no relaxation law 'slow' (model.relaxation); it has no such law at all");
  PluginLaws laws;
  const auto none = [](const Scene&, double) { return nullptr; };
  laws.relaxations["fast"] = laws.relaxations["fair"] = none;
  scene.plugin_laws.laws = std::make_shared<PluginLaws>(laws);
  EXPECT_EQ(refusal_of(begin),
            "laws.so: has no relaxation law 'slow' (model.relaxation); take one of: fair, fast");
  scene.plugin_laws.relaxation = "fast";
  EXPECT_TRUE(says(refusal_of(begin), "laws.so: relaxation 'fast' was not made"));
  scene.plugin_laws.laws = nullptr;
  EXPECT_TRUE(says(refusal_of(begin), "set model.plugin to the plugin's file"));
}

TEST(PluginLaws, AnErrorThatALawThrowsNamesIt) {
  PluginLaws laws;
  laws.displacements["thrown"] = [](const Scene&, double) -> std::unique_ptr<Displacer> {
    throw std::runtime_error("no table");
  };
  laws.displacements["number"] = [](const Scene&, double) -> std::unique_ptr<Displacer> { throw 7; };
  laws.displacements["sentence"] = [](const Scene&, double) -> std::unique_ptr<Displacer> {
    throw_input_error("model.parameters[0] = 0 is no length");
  };
  Scene scene = scene_with_laws(laws);
  const auto begin = [&] { Simulation(scene, starting_bed(scene.bed), down_and_along()); };
  scene.plugin_laws.displacement = "thrown";
  EXPECT_EQ(refusal_of(begin), "displacement 'thrown' failed: no table; correct the law");
  scene.plugin_laws.displacement = "number";
  EXPECT_TRUE(says(refusal_of(begin), "displacement 'number' failed"));
  scene.plugin_laws.displacement = "sentence";
  EXPECT_EQ(refusal_of(begin), "model.parameters[0] = 0 is no length");
}

TEST(SandWatch, SeesSandThatIsMadeOrLostButNoRounding) {
  HeightField bed(70, 80, 0.01);
  bed.set(3, 4, 0.5);
  SandWatch watch(bed);
  const auto check = [&] { watch.check(bed, "law 'x'"); };
  EXPECT_NO_THROW(check());
  for (int i = 0; i < 30; ++i) {
    bed.set(10, 10 + i, 0.1);
    bed.set(40, 10 + i, -0.1);
  }
  bed.set(10, 10, 0.1 + 1e-12);
  EXPECT_NO_THROW(check());
  bed.set(10, 10, 0.1 + 1e-6);
  EXPECT_TRUE(says(refusal_of(check, ErrorKind::unstable), "law 'x' made 1e-10 m^3 of sand"));
  bed.set(10, 10, 0.0);
  EXPECT_TRUE(says(refusal_of(check, ErrorKind::unstable), "law 'x' lost 1e-05 m^3 of sand"));
  bed.set(10, 10, 0.1);
  EXPECT_NO_THROW(check());
  HeightField other(bed.grid(), bed.cell_size());
  EXPECT_NO_THROW(watch.check(other, "a bed in its place"));
  other.set(69, 79, 0.1);
  EXPECT_THROW(watch.check(other, "a bed in its place"), Error);
  EXPECT_NO_THROW(check());
  bed.set(10, 10, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(says(refusal_of(check, ErrorKind::unstable), "law 'x' left a height that is not a number"));
}

}  // namespace
}  // namespace sandstroke
