#include "io/run_state.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "core/input_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class StateFiles : public testing::Test {
 protected:
  StateFiles() {
    StateFile file(
        path, [this] { return run; }, 1e-9);
    file.checkpoints("").keep("what the simulation knows");
  }
  std::string refusal(const RunState& other) const {
    try {
      StateFile(
          path, [&] { return other; }, 0.0)
          .kept();
      return "";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      return error.what();
    }
  }
  TestFolder folder;
  const fs::path path = folder / "a.h5.state";
  RunState run{"commit", "[bed]\ncells = 3\n", "stroke", "surface", false};
};

TEST_F(StateFiles, AreReadByTheSameRunOnly) {
  EXPECT_EQ(StateFile(
                path, [this] { return run; }, 0.0)
                .kept(),
            "what the simulation knows");
  EXPECT_EQ(StateFile(folder / "none", {}, 0.0).kept(), "");
  const auto with = [&](auto RunState::*field, auto value) {
    RunState other = run;
    other.*field = value;
    return refusal(other);
  };
  EXPECT_NE(
      with(&RunState::commit, "other").find("a.h5.state: was kept by the build commit, and this is other"),
      std::string::npos);
  EXPECT_NE(with(&RunState::scene, "[bed]\ncells = 4\n").find("it has cells = 3, this scene cells = 4"),
            std::string::npos);
  EXPECT_NE(with(&RunState::stroke_hash, "other").find("another stroke"), std::string::npos);
  EXPECT_NE(with(&RunState::surface_hash, "other").find("another starting surface"), std::string::npos);
  EXPECT_NE(with(&RunState::estimates_error, true).find("without --estimate-error"), std::string::npos);
}

TEST_F(StateFiles, AreRefusedWhenDamaged) {
  std::string bytes = read_text_file(path);
  bytes[bytes.size() / 2] ^= 1;
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_NE(refusal(run).find("changed since it was kept"), std::string::npos) << refusal(run);
  std::ofstream(path) << "mine";
  EXPECT_NE(refusal(run).find("this is not a run's state"), std::string::npos) << refusal(run);
}

TEST_F(StateFiles, GoWithAPartOfTheSameScene) {
  StateFile file(
      path, [this] { return run; }, 0.0);
  EXPECT_THROW(state_with_part(file, folder / "a.h5", run.scene), Error);
  std::ofstream(folder / "a.h5.part") << "mine";
  EXPECT_THROW(state_with_part(file, folder / "a.h5", run.scene), Error);
  remove_state(path);
  EXPECT_EQ(state_with_part(file, folder / "a.h5", run.scene), "");
}

TEST(RunState, IsNotKnownOfAPluginsLawNorNeededWithoutAStroke) {
  Scene scene;
  EXPECT_FALSE(keeps_state(scene));
  scene.stroke.emplace();
  EXPECT_TRUE(keeps_state(scene));
  scene.plugin_laws.force = "mine";
  EXPECT_FALSE(keeps_state(scene));
}

}  // namespace
}  // namespace sandstroke
