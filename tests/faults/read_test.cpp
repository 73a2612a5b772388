// Files that the disk does not give back, or only a few bytes at a time.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include "faults/commands_test.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

/// Small: each command is run many times.
void write_small_scene(const fs::path& folder) {
  fs::create_directories(folder);
  write_file(folder / "scene.toml",
             "[bed]\nsize = [0.3, 0.2]\ncells = [45, 30]\n[stroke]\nfile = \"line.toml\"\n"
             "[view]\nsize = [160, 90]\n");
  write_file(folder / "line.toml",
             "start = [-0.02, 0.0]\nspeed = 0.2\n"
             "[[segment]]\nkind = \"line\"\nto = [0.02, 0.0]\ndepth = 0.004\n");
}

/// line.csv takes several reads.
void prepare_strokes(const fs::path& folder) {
  write_small_scene(folder);
  make({"stroke", "script", "line.toml", "line.h5"}, folder);
  std::string table = "time,x,y,z\n";
  for (int i = 0; i < 5000; ++i) table += fmt::format("{},{},0.0,-0.002\n", 1e-4 * i, 1e-5 * i);
  write_file(folder / "line.csv", table);
}

void prepare_made_run(const fs::path& folder) {
  prepare_strokes(folder);
  make({"run", "scene.toml", "-o", "a.h5", "--png", "a.png"}, folder);
}

void prepare_two_runs(const fs::path& folder) {
  prepare_made_run(folder);
  for (const char* kind : {".h5", ".png"})
    fs::copy(folder / (std::string("a") + kind), folder / (std::string("b") + kind));
}

void prepare_scene(const fs::path& folder) { write_small_scene(folder / "strokes/tiny"); }

void prepare_check(const fs::path& folder) {
  prepare_scene(folder);
  make({"golden", "update", "tiny"}, folder);
}

void prepare_plan(const fs::path& folder) {
  write_small_scene(folder);
  write_file(folder / "plan.toml", "[sweep]\nscene = \"scene.toml\"\n[axes]\nforce.k_s = [500, 1000]\n");
}

void prepare_collect(const fs::path& folder) {
  prepare_plan(folder);
  make({"sweep", "plan.toml", "-o", "out"}, folder);
  for (const char* name : {"sweep.h5", "sweep.csv", "sweep.html"}) fs::remove(folder / "out" / name);
}

const FaultedCommand reading_commands[] = {
    {"run",
     {"run", "scene.toml", "-o", "a.h5", "--png", "a.png"},
     write_small_scene,
     {"a.h5", "a.xdmf", "a.png"}},
    {"run of a recorded stroke",
     {"run", "scene.toml", "--stroke", "line.h5", "--set", "bed.surface.kind=file", "--set",
      "bed.surface.file=a.h5", "-o", "b.h5"},
     prepare_made_run,
     {"b.h5"}},
    {"sweep", {"sweep", "plan.toml", "-o", "out"}, prepare_plan, {"out/sweep.h5", "out/points/000001.h5"}},
    {"sweep collect", {"sweep", "collect", "out"}, prepare_collect, {"out/sweep.h5", "out/sweep.csv"}},
    {"sweep status", {"sweep", "status", "out"}, prepare_collect, {}},
    {"golden update",
     {"golden", "update", "tiny"},
     prepare_scene,
     {"golden/tiny/golden.h5", "golden/tiny/picture.png", "golden/tiny/provenance.toml"}},
    {"golden check", {"golden", "check", "tiny"}, prepare_check, {}},
    record_command,
    {"render", {"render", "a.h5", "-o", "b.png"}, prepare_made_run, {"b.png"}},
    {"report", {"report", "a.h5"}, prepare_made_run, {"a.html"}},
    {"export", {"export", "a.h5", "-o", "a.obj"}, prepare_made_run, {"a.obj"}},
    {"compare runs", {"compare", "a.h5", "b.h5"}, prepare_two_runs, {}},
    {"compare pictures", {"compare", "a.png", "b.png"}, prepare_two_runs, {}},
    {"info", {"info", "a.h5"}, prepare_made_run, {}},
    {"stroke info of a recorded one", {"stroke", "info", "line.h5"}, prepare_strokes, {}},
    {"stroke info of a script", {"stroke", "info", "line.toml"}, prepare_strokes, {}},
    {"stroke convert",
     {"stroke", "convert", "line.csv", "new.h5", "--time", "time", "--position", "x,y,z", "--position-unit",
      "m", "--time-unit", "s"},
     prepare_strokes,
     {"new.h5"}},
    {"stroke script", {"stroke", "script", "line.toml", "new.h5"}, prepare_strokes, {"new.h5"}},
};

class Reading : public CommandsTest {};
INSTANTIATE_TEST_SUITE_P(, Reading, testing::ValuesIn(reading_commands), name_of);

/// Its last line is the sentence; warnings may come before.
void expect_sentence(const std::string& err, const std::string& where) {
  const std::size_t last = err.rfind('\n', err.size() - 2);
  const std::string line = err.substr(last == std::string::npos ? 0 : last + 1);
  EXPECT_TRUE(line.starts_with("sandstroke: ") && line.find("Input/output error") != std::string::npos)
      << where << ": " << err;
}

TEST_P(Reading, GivesTheSameOrSaysThatItCannot) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  Disturbed disturbed(GetParam());
  const bool prints = GetParam().products.empty();  // that is its result
  const auto is_right = [&](const ProgramResult& result) {
    return result.exit_code == 0 &&
           (prints ? result.out == disturbed.printed() : disturbed.state() == "all of the result");
  };
  ProgramResult result = disturbed.run({.in_child = faulty_system("short")});
  EXPECT_TRUE(is_right(result)) << "a few bytes at a time: " << result.exit_code << result.err << result.out;

  const long reads = disturbed.calls().reads;
  ASSERT_GT(reads, 0);
  std::map<std::string, int> outcomes;
  const long faults = std::min<long>(fault_repeats(), reads - 1);  // and the last
  for (long i = 0; i <= faults; ++i) {
    const long read = reads - (faults - i) * (reads - 1) / std::max(1l, faults);
    const std::string where = fmt::format("damaged from read {} of {} on", read, reads);
    result = disturbed.run({.in_child = faulty_system(fmt::format("read:{}", read))});
    outcomes[outcome(result, disturbed)]++;
    disturbed.expect_nothing_half(where);
    if (is_right(result)) continue;  // what was not read did not matter
    EXPECT_EQ(result.exit_code, io_error) << where << ": " << result.err << result.out;
    expect_sentence(result.err, where);
  }
  tell("damaged disk, from some read on", GetParam().name, outcomes);
}

/// HDF5 does not say why it failed: what reads well the next time may be said to be damaged, but never
/// absent.
TEST(ReadingOnce, GivesTheSameOrSaysThatItCannot) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  const FaultedCommand command{"", {"stroke", "info", "line.h5"}, prepare_strokes, {}};
  Disturbed disturbed(command);
  const long reads = disturbed.calls().reads;
  for (long read = 1; read <= reads; ++read) {
    const ProgramResult result = disturbed.run({.in_child = faulty_system(fmt::format("once:{}", read))});
    if (result.exit_code == 0)
      EXPECT_EQ(result.out, disturbed.printed()) << read;
    else
      EXPECT_TRUE(result.exit_code <= io_error && result.err.starts_with("sandstroke: "))
          << read << result.err;
  }
}

/// A recording that was cut off is never complete, unlike the files above.
TEST(ReadingAJournal, GivesTheSameOrSaysThatItCannot) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  const fs::path folder = test_folder();
  record_command.prepare(folder);
  run_program(record_command.arguments, folder, {.in_child = faulty_system("kill:10")});
  ASSERT_TRUE(fs::exists(folder / "hand.h5.recording"));
  const auto repair = [&](const char* fault) {
    fs::remove(folder / "new.h5");
    return run_program({"stroke", "repair", "hand.h5", "new.h5"}, folder, {.in_child = faulty_system(fault)});
  };
  const ProgramResult right = repair("none");
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(repair("short").out, right.out);
  const ProgramResult damaged = repair("read:1");  // later ones are of what it wrote, to check it
  EXPECT_EQ(damaged.exit_code, io_error) << damaged.err;
  expect_sentence(damaged.err, "read:1");
  EXPECT_FALSE(fs::exists(folder / "new.h5"));
}

}  // namespace
}  // namespace sandstroke
