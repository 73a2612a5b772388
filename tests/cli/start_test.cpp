// The program loads libraries to draw only for pictures: they take 20 ms and 50 MB.
#include <gtest/gtest.h>

#include <cstdlib>

#include "cli/program.h"

namespace sandstroke {
namespace {
namespace fs = std::filesystem;

/// The names of all libraries that it loads, among other words; it must succeed.
std::string loaded_by(const std::vector<std::string>& arguments, const fs::path& folder) {
  Conditions conditions;
  conditions.in_child = [] { setenv("LD_DEBUG", "files", 1); };
  const ProgramResult result = run_program(arguments, folder, conditions);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return result.err;
}

bool names(const std::string& text, const std::string& library) {
  return text.find(library) != std::string::npos;
}

TEST(CliStart, NothingToDrawWithIsLoadedWithoutAPicture) {
  const fs::path folder = test_folder();
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--version"},
                                                    {"run", "scene.toml", "-o", "run.h5"},
                                                    {"report", "run.h5", "--help"}}) {
    const std::string loaded = loaded_by(arguments, folder);
    EXPECT_TRUE(names(loaded, "libstdc++.so")) << arguments[0];
    for (const std::string library : {"libOSMesa", "libgallium", "swrast_dri", "libLLVM"})
      EXPECT_FALSE(names(loaded, library)) << library << " by " << arguments[0];
  }
  const std::string loaded = loaded_by({"run", "scene.toml", "-o", "run.h5", "--png", "run.png"}, folder);
  EXPECT_TRUE(names(loaded, "libLLVM"));
}

TEST(CliStart, OnlyPicturesFailWithoutOsMesaAndSayWhatToInstall) {
  const fs::path folder = test_folder();
  if (!names(loaded_by({"run", "scene.toml", "-o", "run.h5", "--png", "run.png"}, folder), "libOSMesa"))
    GTEST_SKIP() << "pictures are drawn through EGL";
  fs::create_directory(folder / "lib");
  write_file(folder / "lib/libOSMesa.so.8", "damaged");
  Conditions conditions;
  conditions.in_child = [&] { setenv("LD_LIBRARY_PATH", (folder / "lib").c_str(), 1); };
  EXPECT_EQ(run_program({"run", "scene.toml", "-o", "without.h5"}, folder, conditions).exit_code, 0);
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "scene.toml", "-o", "new.h5", "--png", "new.png"},
        {"render", "run.h5", "-o", "new.png"}}) {
    const ProgramResult result = run_program(arguments, folder, conditions);
    EXPECT_EQ(result.exit_code, 4);
    EXPECT_NE(
        result.err.find("sandstroke: pictures are drawn by the library OSMesa, which cannot be loaded ("),
        std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("libOSMesa.so.8"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("apt-get install libosmesa6"), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder / "new.png"));
    EXPECT_FALSE(fs::exists(folder / "new.h5"));  // said before the work is done
  }
}

}  // namespace
}  // namespace sandstroke
