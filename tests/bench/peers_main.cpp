// sandstroke_peers: the study's piles once more, with rules that others ship beside this library's.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "bench/peers.h"
#include "validation/study/study_files.h"
#include "validation/study/study_summary.h"

int main(int argc, char** argv) {
  using namespace sandstroke;
  CLI::App app("Run time against error of sandstroke and of rules that others ship");
  StudyOptions options;
  options.problems = {"cylinder", "truncated", "cone", "cliff", "trench"};
  options.peers = published_peers();
  std::string folder = "peers";
  app.add_flag("--quick", options.quick, "Coarser grids");
  app.add_option("--scene", options.problems, "Only this problem (repeatable)");
  app.add_option("--repeats", options.repeats, "Of each run");
  app.add_option("-o,--output", folder, "Folder for bench.html, bench.csv and bench.h5")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    const StudyFiles files(folder);
    const Study study = run_study(options);
    files.write(study);
    std::printf("%s\npage  %s\n", study_summary(study).c_str(), files.page().c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sandstroke_peers: %s\n", error.what());
    return 1;
  }
}
