#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "cli/commands.h"
#include "cli/help_formatter.h"
#include "cli/standard_output.h"
#include "cli/usage_sentence.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "core/log.h"
#include "core/machine.h"
#include "core/output_file.h"
#include "core/terminal_text.h"
#include "core/version.h"
#include "sand/instruction_set.h"

namespace {

using namespace sandstroke;

constexpr int io_error = 4;

/// Prints an error sentence. A closed stderr does not change the exit code (fmt::print would throw).
void complain(const std::string& sentence) {
  std::fputs(("sandstroke: " + terminal_line(sentence) + "\n").c_str(), stderr);
}

int complain_of_threads(const std::exception& failure) {
  complain(
      fmt::format("no more threads can be started ({}); close other programs, or raise the limits of threads "
                  "or memory (ulimit -u, ulimit -v)",
                  failure.what()));
  return io_error;
}

int run(const Command& command) {
  try {
    const int exit_code = command();
    flush_output();
    return exit_code;
  } catch (const std::system_error& failure) {
    if (std::ferror(stdout)) throw_output_error(failure.code().value());  // fmt::print threw it
    throw;
  }
}

int run_program(int argc, char** argv) {
  CLI::App app(
      "Simulates sand that is sculpted with a haptic device. A stroke goes in. A height field, a trace of "
      "forces and a picture come out.");
  app.name("sandstroke");
  app.formatter(std::make_shared<HelpFormatter>());  // for all commands
  app.set_version_flag("--version", fmt::format("{}, {}{}{}", build, instruction_set(),
                                                *left_out ? ", built without " : "", left_out));
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Exit codes:\n"
      "  0        fine\n"
      "  1        a comparison or record --check failed, or a recording skipped too many ticks\n"
      "  2        bad input or usage\n"
      "  3        a run is not at rest or unstable (or has a warning, with --strict), a sweep's point "
      "failed, or\n"
      "           stress found a surprise\n"
      "  4        a file or a device cannot be read or written\n"
      "  128 + n  stopped by signal n: 130 by Ctrl-C, 143 by kill\n"
      "Begin with: sandstroke init FOLDER. To play your own recording: sandstroke run SCENE --stroke FILE. "
      "Help on a command: sandstroke run --help\n"
      "In Python: import sandstroke; run = sandstroke.run(\"scene.toml\"); run.final");
  bool quiet = false;
  app.add_flag("-q,--quiet", quiet, "Print only results, warnings and errors");
  bool overwrite = false;
  app.add_flag("--overwrite", overwrite,
               "Let outputs replace any file. Without it they replace only files that sandstroke wrote, and "
               "never a stroke, a recording, a film, or an exported .npy or .asc");

  Command chosen;
  add_init_command(app, chosen);
  add_run_command(app, chosen);
  add_render_command(app, chosen);
  add_report_command(app, chosen);
  add_export_command(app, chosen);
  add_compare_command(app, chosen);
  add_golden_command(app, chosen);
  add_sweep_command(app, chosen);
  add_fit_command(app, chosen);
  add_stroke_command(app, chosen);
  add_record_command(app, chosen);
  add_bench_command(app, chosen);
  add_stress_command(app, chosen);
  add_info_command(app, chosen);
  add_completion_command(app, chosen);
  add_help_command(app, chosen);  // last: it needs the others

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& failure) {
    const std::string sentence = usage_sentence(app, failure);
    if (!sentence.empty()) throw_input_error("{}", sentence);
    return run([&] { return app.exit(failure); });  // the user asked for help or the version
  }
  start_log(quiet);
  if (overwrite) overwrite_outputs();
  return run(chosen);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    check_stack();
    ignore_write_signals();
    share_heap_if_limited();
    return run_program(argc, argv);
  } catch (const Error& failure) {
    complain(failure.what());
    return failure.exit_code();
  } catch (const std::bad_alloc&) {
    complain("out of memory; take a smaller bed or picture, or close other programs");
    return io_error;
  } catch (const std::filesystem::filesystem_error& failure) {
    complain(fmt::format("{}: {}; check the path and its permissions", failure.path1().string(),
                         failure.code().message()));
    return io_error;
  } catch (const std::system_error& failure) {
    return complain_of_threads(failure);
  } catch (const std::exception& failure) {
    if (std::string_view(failure.what()).starts_with("pthread_create"))  // thrown by TBB
      return complain_of_threads(failure);
    complain(fmt::format("unexpected failure: {}", failure.what()));
    return io_error;
  }
}
