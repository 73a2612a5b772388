#include "faults/faulted_command.h"

#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <stdlib.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "faults/content.h"
#include "sanitized.h"

namespace sandstroke {

namespace fs = std::filesystem;

void make(const std::vector<std::string>& arguments, const fs::path& folder) {
  const ProgramResult made = run_program(arguments, folder);
  ASSERT_EQ(made.exit_code, 0) << made.err;
}

namespace {

void write_scene(const fs::path& folder, const std::string& settings = "") {
  write_file(folder / "scene.toml",
             "[bed]\nsize = [0.3, 0.2]\ncells = [150, 100]\n[stroke]\nfile = \"line.toml\"\n"
             "[view]\nsize = [160, 90]\n" +
                 settings);
  write_file(folder / "line.toml",
             "start = [-0.05, 0.0]\nspeed = 0.2\n"
             "[[segment]]\nkind = \"line\"\nto = [0.05, 0.0]\ndepth = 0.004\n"
             "[[segment]]\nkind = \"line\"\nto = [0.0, 0.05]\ndepth = 0.006\n");
}

void prepare_run(const fs::path& folder) { write_scene(folder); }

void prepare_sweep(const fs::path& folder) {
  write_scene(folder);
  write_file(folder / "plan.toml",
             "[sweep]\nscene = \"scene.toml\"\nkeep = [\"surface\", \"picture\"]\n[axes]\n"
             "device.model = [\"dynamic\"]\nforce.k_s = { from = 500, to = 1500, count = 4 }\n");
}

/// There is an entry already, of another scene.
void prepare_golden(const fs::path& folder) {
  const fs::path scenes = folder / "strokes/tiny";
  fs::create_directories(scenes);
  write_scene(scenes, "[relaxation]\ntalus_angle = 25.0\n");
  make({"golden", "update", "tiny"}, folder);
  write_scene(scenes);
}

void prepare_record(const fs::path& folder) {
  write_file(folder / "short.toml",
             "start = [-0.02, 0.0]\nspeed = 0.2\nplunge_speed = 0.5\n"
             "[[segment]]\nkind = \"line\"\nto = [0.02, 0.0]\ndepth = 0.004\n");
}

void prepare_render(const fs::path& folder) {
  write_scene(folder);
  make({"run", "scene.toml", "-o", "a.h5", "--frames", "5"}, folder);
}

std::vector<std::string> frames(int count) {
  std::vector<std::string> files;
  for (int k = 0; k < count; ++k) files.push_back(fmt::format("film/frame_{:04}.png", k));
  return files;
}

/// The size of a folder as a file system of pages counts it.
long kilobytes_of(const fs::path& folder) {
  long sum = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) sum += 4 * static_cast<long>((entry.file_size() + 4095) / 4096);
  return sum;
}

/// Does as a user before the same recording again: what was recorded is not written over.
void save_recording(const fs::path& folder) {
  if (!fs::exists(folder / "hand.h5.recording")) return;
  const ProgramResult repair = run_program({"stroke", "repair", "hand.h5", "saved.h5", "--remove"}, folder);
  if (repair.exit_code != 0) {
    EXPECT_NE(repair.err.find("has no sample"), std::string::npos) << repair.err;
    fs::remove(folder / "hand.h5.recording");
  } else {
    EXPECT_EQ(run_program({"stroke", "info", "saved.h5"}, folder).exit_code, 0);
    fs::remove(folder / "saved.h5");
  }
}

}  // namespace

const FaultedCommand run_command{"run",
                                 {"run", "scene.toml", "-o", "a.h5", "--frames", "20", "--png", "a.png"},
                                 prepare_run,
                                 {"a.h5", "a.xdmf", "a.png"}};
const FaultedCommand sweep_command{
    "sweep",
    {"sweep", "plan.toml", "-o", "out"},
    prepare_sweep,
    {"out/sweep.h5", "out/points/000000.h5", "out/points/000003.png", "out/points/000001.h5"}};
const FaultedCommand golden_command{
    "golden update",
    {"golden", "update", "tiny"},
    prepare_golden,
    {"golden/tiny/golden.h5", "golden/tiny/picture.png", "golden/tiny/provenance.toml"},
    true};
const FaultedCommand record_command{
    "record",       {"record", "--max-skipped", "100", "-o", "hand.h5", "--device", "scripted:short.toml"},
    prepare_record, {"hand.h5"},
    false,          true};
const FaultedCommand render_command{
    "render --frame all", {"render", "a.h5", "--frame", "all", "-o", "film"}, prepare_render, frames(8)};

void PrintTo(const FaultedCommand& command, std::ostream* out) { *out << command.name; }

Disturbed::Disturbed(const FaultedCommand& command) : command_(command) {
  const fs::path place = test_folder();
  inputs_ = place / "inputs";
  folder_ = place / "work";
  fs::create_directories(inputs_);
  command.prepare(inputs_);
  folder_ = inputs_;
  before_ = products();
  folder_ = place / "work";
  const auto start = std::chrono::steady_clock::now();
  const ProgramResult undisturbed = run({});
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_EQ(undisturbed.exit_code, 0) << undisturbed.err;
  printed_ = undisturbed.out;
  after_ = products();
  EXPECT_EQ(after_.size(), command.products.size());
  kilobytes_before_ = kilobytes_of(inputs_);
  kilobytes_after_ = kilobytes_of(folder_);
  EXPECT_EQ(damage_in(folder_), "");
}

Disturbed::~Disturbed() {
  std::error_code ignored;
  if (!testing::Test::HasFailure()) fs::remove_all(folder_.parent_path(), ignored);
}

void Disturbed::prepare() {
  fs::create_directories(folder_);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) fs::remove_all(entry.path());
  fs::copy(inputs_, folder_, fs::copy_options::recursive);
}

ProgramResult Disturbed::start(Conditions conditions) const {
  conditions.in_child = [this, more = conditions.in_child] {
    setenv("TMPDIR", folder_.parent_path().c_str(), 1);  // whatever a killed program leaves there
    if (more) more();
  };
  return run_program(command_.arguments, folder_, conditions);
}

ProgramResult Disturbed::run(const Conditions& conditions) {
  prepare();
  return start(conditions);
}

Disturbed::Products Disturbed::products() const {
  Products contents;
  for (const std::string& file : command_.products) {
    if (!fs::exists(folder_ / file)) continue;
    try {
      contents[file] = content_of(folder_ / file);
      if (command_.records) contents[file] = "a recording";  // no two have the same times
    } catch (const std::exception& failure) {
      contents[file] = failure.what();
    }
  }
  return contents;
}

Disturbed::Counts Disturbed::calls() {
  const fs::path count = folder_.parent_path() / "count";
  EXPECT_EQ(run({.in_child = faulty_system("count:" + count.string())}).exit_code, 0);
  Counts counts;
  std::istringstream(read_file(count)) >> counts.changes >> counts.reads;
  return counts;
}

void Disturbed::expect_nothing_half(const std::string& where) const {
  EXPECT_EQ(damage_in(folder_), "") << where;
  const Products now = products();
  for (const auto& [file, content] : now) {
    const auto old = before_.find(file);
    EXPECT_TRUE(content == after_.at(file) || (old != before_.end() && content == old->second))
        << where << ": " << file << " is neither as before nor as it should be: " << content;
  }
  if (command_.together) {
    EXPECT_TRUE(now == before_ || now == after_) << where << ": a mixture of old and new";
  }
}

void Disturbed::expect_rerun(const std::string& where) const {
  std::vector<std::string> arguments = command_.arguments;
  if (command_.records) {
    save_recording(folder_);
    arguments.emplace_back("--overwrite");
  }
  const ProgramResult again = run_program(arguments, folder_);
  EXPECT_EQ(again.exit_code, 0) << where << ": " << again.err;
  EXPECT_EQ(products(), after_) << where;
  EXPECT_EQ(damage_in(folder_), "") << where;
}

std::string Disturbed::state() const {
  const Products now = products();
  std::string text = now == after_ ? "all of the result" : "part of the result's files";
  if (now == before_) text = before_.empty() ? "no result" : "as before";
  if (const fs::path part = folder_ / "a.h5.part"; fs::exists(part))
    text += can_be_read(part) ? ", a .part that can be read" : ", a .part that cannot be read";
  return text;
}

std::function<void()> faulty_system(const std::string& fault) {
  return [fault] {
    setenv("SANDSTROKE_FAULT", fault.c_str(), 1);
    setenv("LD_PRELOAD", SANDSTROKE_FAULTY_SYSTEM, 1);
  };
}

std::vector<long> some_calls(long calls) {
  const long some = fault_repeats(), last = std::max(1l, calls - some);
  std::vector<long> chosen;
  for (long i = 0; i < some; ++i) chosen.push_back(1 + i * last / some);
  for (long call = last; call <= calls; ++call) chosen.push_back(call);
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

std::string outcome(const ProgramResult& result, const Disturbed& disturbed) {
  return fmt::format("exit code {}, {}", result.exit_code, disturbed.state());
}

int fault_repeats() {
  const char* text = std::getenv("SANDSTROKE_FAULT_REPEATS");
  return text ? std::max(1, std::atoi(text)) : sanitized ? 1 : 2;
}

void tell(const std::string& fault, const std::string& command, int times, const std::string& outcome) {
  const char* path = std::getenv("SANDSTROKE_FAULT_TABLE");
  if (!path) return;
  const bool failed = testing::Test::HasFailure();
  std::ofstream(path, std::ios::app) << fmt::format("| {} | {} | {} | {}{} |\n", fault, command, times,
                                                    failed ? "FAILED: " : "", outcome);
}

void tell(const std::string& fault, const std::string& command, const std::map<std::string, int>& outcomes) {
  int times = 0;
  std::string text;
  for (const auto& [outcome, count] : outcomes) {
    times += count;
    text += fmt::format("{}{} x {}", text.empty() ? "" : ", ", count, outcome);
  }
  tell(fault, command, times, text);
}

}  // namespace sandstroke
