#include <spdlog/fmt/fmt.h>

#include <array>
#include <filesystem>
#include <memory>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "core/asset.h"
#include "core/error.h"
#include "core/output_file.h"
#include "core/shell_text.h"

// Embedded by assets.S.
SANDSTROKE_DECLARE_ASSET(init_scene);
SANDSTROKE_DECLARE_ASSET(init_stroke);
SANDSTROKE_DECLARE_ASSET(init_sweep);

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

struct ExampleFile {
  const char* name;
  const char* what;
  std::string_view text;
};

int init(const fs::path& folder) {
  const std::array<ExampleFile, 3> files = {{
      {"scene.toml", "the scene: sand, tool, forces, view", SANDSTROKE_ASSET(init_scene)},
      {"stroke.toml", "the hand's stroke", SANDSTROKE_ASSET(init_stroke)},
      {"sweep.toml", "a sweep: the same scene with other settings", SANDSTROKE_ASSET(init_sweep)},
  }};
  for (const ExampleFile& file : files)
    if (fs::exists(fs::symlink_status(folder / file.name)))
      throw_input_error("{}: already exists, and init does not replace files; name another folder",
                        (folder / file.name).string());
  make_folder(folder);
  try {
    for (const ExampleFile& file : files) write_text_file(folder / file.name, file.text);
  } catch (...) {  // writes all files or none, so that a second try replaces no file
    std::error_code ignored;
    for (const ExampleFile& file : files) fs::remove(folder / file.name, ignored);
    throw;
  }
  for (const ExampleFile& file : files) print_text("{:<30} {}\n", (folder / file.name).string(), file.what);
  const auto in_folder = [&](const char* name) { return shell_quoted((folder / name).string()); };
  print_text(
      "\nComments in each file say what you can change. Next:\n"
      "  sandstroke run {0} -o {1} --png {2}\n"
      "  sandstroke render {1} --view top --style height -o {5}\n"
      "  sandstroke sweep {3} -o {4}\n",
      in_folder("scene.toml"), in_folder("run.h5"), in_folder("run.png"), in_folder("sweep.toml"),
      in_folder("sweep"), in_folder("heights.png"));
  return 0;
}

}  // namespace

void add_init_command(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("init", "Write an example scene, stroke and sweep plan");
  auto folder = std::make_shared<fs::path>();
  command->add_option("FOLDER", *folder, "Folder for the example; it is made if it does not exist")
      ->type_name("FOLDER")
      ->option_text("REQUIRED")
      ->required();
  command->footer("Example:  sandstroke init garden");
  command->callback([folder, &chosen] { chosen = [folder] { return init(*folder); }; });
}

}  // namespace sandstroke
