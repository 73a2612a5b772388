#include <gtest/gtest.h>

#include <map>

#include "cli/program.h"
#include "hdf5/hdf5_file.h"
#include "io/png_file.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

TEST(CliRender, DrawsEveryViewStyleAndFrame) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "4"}, folder).exit_code, 0);
  for (const char* view : {"overview", "stroke", "top"})
    for (const char* style : {"sand", "height", "difference"}) {
      const ProgramResult render =
          run_program({"render", "a.h5", "-o", "a.png", "--view", view, "--style", style}, folder);
      EXPECT_EQ(render.exit_code, 0) << view << " " << style << ": " << render.err;
      EXPECT_GT(fs::file_size(folder / "a.png"), 5000u);
    }
  ASSERT_EQ(run_program({"render", "a.h5", "--frame", "all", "-o", "film", "--tool"}, folder).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "film/frame_0000.png"));
  EXPECT_EQ(run_program({"compare", "a.png", "film/frame_0000.png"}, folder).exit_code, 1);
  EXPECT_EQ(run_program({"compare", "a.png", "a.png"}, folder).exit_code, 0);
}

/// Mesa's other drivers cannot draw these pictures, and one of them crashes.
TEST(CliRender, DrawsTheSameWhateverDriverTheUserAsksOfMesa) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"render", "a.h5", "-o", "a.png"}, folder).exit_code, 0);
  for (const char* driver : {"softpipe", "zink", "none"}) {
    Conditions conditions;
    conditions.in_child = [driver] { setenv("GALLIUM_DRIVER", driver, 1); };
    const ProgramResult render =
        run_program({"render", "a.h5", "-o", "b.png", "--overwrite"}, folder, conditions);
    EXPECT_EQ(render.exit_code, 0) << driver << ": " << render.err;
    EXPECT_TRUE(read_file(folder / "b.png") == read_file(folder / "a.png")) << driver;
  }
}

TEST(CliRender, PicturesOfASceneHaveOneCameraWhateverTheSandDid) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "b.h5", "--set", "relaxation.talus_angle=15"}, folder)
                .exit_code,
            0);
  for (const char* view : {"overview", "stroke", "top"}) {
    for (const std::string run : {"a", "b"}) {
      const ProgramResult render = run_program(
          {"render", run + ".h5", "--frame", "initial", "-o", run + ".png", "--view", view}, folder);
      ASSERT_EQ(render.exit_code, 0) << render.err;
    }
    EXPECT_TRUE(read_png(folder / "a.png").rgb == read_png(folder / "b.png").rgb) << view;
  }
}

TEST(CliRender, APictureWithoutANameIsNamedAfterWhatItShows) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "4"}, folder).exit_code, 0);
  for (const auto& [frame, name] : std::map<std::string, std::string>{
           {"final", "a.png"}, {"initial", "a_initial.png"}, {"2", "a_frame_0002.png"}}) {
    const ProgramResult render = run_program({"render", "a.h5", "--frame", frame}, folder);
    EXPECT_EQ(render.out, name + "\n") << render.err;
    EXPECT_TRUE(fs::exists(folder / name));
  }
}

TEST(CliRender, AFrameOfAnotherShapeThanTheBedIsRefused) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5", "--frames", "5"}, folder).exit_code, 0);
  {
    const Hdf5Handle file(H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDWR, without_locks()), H5Fclose);
    const char *frame = "/surface/frame/000003", *changed = "/surface/frame/000003/changed";
    ASSERT_GE(H5Ldelete(file, changed, H5P_DEFAULT), 0);
    const hsize_t shape[2] = {640, 640};
    const Hdf5Handle space(H5Screate_simple(2, shape, nullptr), H5Sclose);
    const Hdf5Handle group(H5Gopen2(file, frame, H5P_DEFAULT), H5Gclose);
    const Hdf5Handle made(
        H5Dcreate2(group, "changed", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Dclose);
    ASSERT_TRUE(made.valid());
  }
  const ProgramResult render = run_program({"render", "a.h5", "--frame", "3", "-o", "a.png"}, folder);
  EXPECT_EQ(render.exit_code, 2);
  EXPECT_NE(render.err.find("a.h5: /surface/frame/000003/changed differs from /surface/initial in shape"),
            std::string::npos)
      << render.err;
  EXPECT_FALSE(fs::exists(folder / "a.png"));
}

TEST(CliRender, APictureIsAPng) {
  const fs::path folder = test_folder();
  ASSERT_EQ(run_program({"run", "scene.toml", "-o", "a.h5"}, folder).exit_code, 0);
  for (const std::string name : {"a.jpg", "a.txt", "a"}) {
    const ProgramResult render = run_program({"render", "a.h5", "-o", name}, folder);
    EXPECT_EQ(render.exit_code, 2);
    EXPECT_EQ(render.err, "sandstroke: " + name + ": is not the name of a PNG file; end it with .png\n");
    EXPECT_FALSE(fs::exists(folder / name));
  }
}

}  // namespace
}  // namespace sandstroke
