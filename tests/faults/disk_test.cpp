// Disks that are full or read-only, and outputs that somebody removes.
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>

#include <set>

#include "faults/commands_test.h"
#include "faults/small_disk.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class Disk : public CommandsTest {};
SANDSTROKE_FOR_EACH_COMMAND(Disk);

TEST_P(Disk, FullIsAnErrorThatLeavesNothingHalfWritten) {
  Disturbed disturbed(GetParam());
  SmallDisk disk(disturbed.folder(), 1000);
  if (!disk.mounted()) GTEST_SKIP() << "nothing can be mounted here";
  std::map<std::string, int> outcomes;
  const int repeats = fault_repeats();
  for (int i = 0; i < repeats; ++i) {
    const long before = disturbed.kilobytes_before() + 8, after = disturbed.kilobytes_after();
    const long size = before + (after - before) * i / repeats;
    const std::string where = fmt::format("{} kB instead of {}", size, after);
    disk.resize(4 * after);
    disturbed.prepare();
    disk.resize(size);
    const ProgramResult result = disturbed.start();
    EXPECT_EQ(result.exit_code, io_error) << where << result.err;
    EXPECT_NE(result.err, "") << where;
    outcomes[outcome(result, disturbed)]++;
    EXPECT_EQ(disturbed.state().find("cannot be read"), std::string::npos) << where;
    disturbed.expect_nothing_half(where);
    disk.resize(4 * after);
    disturbed.expect_rerun(where);
  }
  tell("full disk (tmpfs)", GetParam().name, outcomes);
}

TEST_P(Disk, FullFromAnyCallOnLeavesNothingHalfWritten) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  Disturbed disturbed(GetParam());
  std::map<std::string, int> outcomes;
  const long calls = disturbed.calls().changes;
  for (const long call : some_calls(calls)) {
    const std::string where = fmt::format("full from call {} of {} on", call, calls);
    const ProgramResult result = disturbed.run({.in_child = faulty_system(fmt::format("full:{}", call))});
    // The last calls need no room.
    EXPECT_TRUE(result.exit_code == io_error ||
                (result.exit_code == 0 && disturbed.state() == "all of the result"))
        << where << ": " << result.exit_code << " " << result.err;
    outcomes[outcome(result, disturbed)]++;
    disturbed.expect_nothing_half(where);
    disturbed.expect_rerun(where);
  }
  tell("full disk, from some call on", GetParam().name, outcomes);
}

TEST_P(Disk, ReadOnlyIsAnErrorThatLeavesNothingHalfWritten) {
  Disturbed disturbed(GetParam());
  SmallDisk disk(disturbed.folder(), 4 * disturbed.kilobytes_after());
  if (!disk.mounted()) GTEST_SKIP() << "nothing can be mounted here";
  disturbed.prepare();
  disk.set_read_only(true);
  const ProgramResult result = disturbed.start();
  EXPECT_EQ(result.exit_code, io_error) << result.err;
  EXPECT_NE(result.err.find("Read-only file system"), std::string::npos) << result.err;
  tell("read-only folder", GetParam().name, {{outcome(result, disturbed), 1}});
  disturbed.expect_nothing_half("read-only");
  disk.set_read_only(false);
  disturbed.expect_rerun("after it was read-only");
}

/// The first file or folder in a folder that has a part of this name; empty: there is none yet.
fs::path appeared(const fs::path& folder, const std::string& part) {
  std::error_code gone;
  for (fs::recursive_directory_iterator entry(folder, gone), end; entry != end; entry.increment(gone))
    if (entry->path().filename().string().find(part) != std::string::npos) return entry->path();
  return {};
}

/// Removes what `which` says as soon as there is a .part or a journal.
Conditions removes(const fs::path& folder, bool whole_folder) {
  Conditions conditions{SIGCONT};  // which does nothing
  conditions.when = [=] {
    fs::path found = appeared(folder, ".part");
    if (found.empty()) found = appeared(folder, ".recording");
    if (found.empty()) return false;
    std::error_code gone;
    fs::remove_all(whole_folder ? found.parent_path() : found, gone);
    return true;
  };
  return conditions;
}

TEST_P(Disk, OutputRemovedWhileItIsWrittenLeavesNothingHalfWritten) {
  Disturbed disturbed(GetParam());
  std::map<std::string, int> outcomes;
  for (const bool whole_folder : {false, true}) {
    const std::string where = whole_folder ? "folder removed" : "file removed";
    const ProgramResult result = disturbed.run(removes(disturbed.folder(), whole_folder));
    EXPECT_TRUE(result.exit_code == io_error ||
                (result.exit_code == 0 && disturbed.state() == "all of the result"))
        << where << ": " << result.exit_code << " " << result.err;
    outcomes[where + ": " + outcome(result, disturbed)]++;
    if (!fs::exists(disturbed.folder() / "scene.toml")) disturbed.prepare();
    disturbed.expect_nothing_half(where);
    disturbed.expect_rerun(where);
  }
  tell("output removed", GetParam().name, outcomes);
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

TEST(GoldenOnDisk, AnUpdateThatFailsLeavesNothing) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  Disturbed disturbed(golden_command);
  const long calls = disturbed.calls().changes;
  for (const long call : some_calls(calls)) {
    disturbed.run({.in_child = faulty_system(fmt::format("full:{}", call))});
    EXPECT_EQ(names_in(disturbed.folder() / "golden"), std::set<std::string>{"tiny"}) << call;
    EXPECT_EQ(names_in(disturbed.folder() / "golden/tiny"),
              (std::set<std::string>{"golden.h5", "picture.png", "provenance.toml"}))
        << call;
  }
}

TEST(SweepOnDisk, APointThatIsRemovedBehindTheSweepIsNotToldAsDone) {
  Disturbed disturbed(sweep_command);
  const fs::path point = disturbed.folder() / "out/points/000000.h5";
  Conditions conditions{SIGCONT};
  conditions.when = [point] { return fs::remove(point); };
  const ProgramResult result = disturbed.run(conditions);
  EXPECT_EQ(result.exit_code, io_error) << result.err;
  EXPECT_NE(result.err.find("1 point is missing; sweep again"), std::string::npos) << result.err;
  disturbed.expect_rerun("a point removed");
}

}  // namespace
}  // namespace sandstroke
