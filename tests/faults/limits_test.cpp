// Little memory, few file descriptors, a clock that jumps, no locks, another process at the same output.
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <thread>

#include "core/machine.h"
#include "faults/commands_test.h"
#include "faults/small_disk.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class Limits : public CommandsTest {};
SANDSTROKE_FOR_EACH_COMMAND(Limits);

constexpr double megabyte = 0x1p20;

std::function<void()> limited(__rlimit_resource resource, double most) {
  return [=] {
    const rlimit limit{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
    setrlimit(resource, &limit);
  };
}

/// Refused in one sentence, or done; never ended by a signal.
void expect_clear(const ProgramResult& result, const Disturbed& disturbed, const std::string& where) {
  if (result.exit_code == 0) {
    EXPECT_EQ(disturbed.state(), "all of the result") << where;
    return;
  }
  EXPECT_TRUE(result.exit_code == input_error || result.exit_code == io_error ||
              result.exit_code == not_loaded)
      << where << ": " << result.exit_code << " " << result.err;
  EXPECT_EQ(result.err.find("unexpected failure"), std::string::npos) << where << ": " << result.err;
  EXPECT_NE(result.err, "") << where;
}

TEST_P(Limits, FewFileDescriptorsAreEnoughOrAClearError) {
  if (sanitized) GTEST_SKIP() << "a sanitizer looks at objects through pipes of its own";
  Disturbed disturbed(GetParam());
  std::map<std::string, int> outcomes;
  for (const int most : {3, 4, 6, 8, 10, 12}) {
    const std::string where = fmt::format("{} file descriptors", most);
    const ProgramResult result = disturbed.run({.in_child = limited(RLIMIT_NOFILE, most)});
    expect_clear(result, disturbed, where);
    outcomes[outcome(result, disturbed)]++;
    disturbed.expect_nothing_half(where);
  }
  disturbed.expect_rerun("with enough file descriptors");
  tell("few file descriptors (3 to 12)", GetParam().name, outcomes);
}

TEST_P(Limits, ASmallAddressSpaceIsEnoughOrAClearError) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes an address space of its own";
  Disturbed disturbed(GetParam());
  std::map<std::string, int> outcomes;
  const int steps = 3 * fault_repeats();
  for (int i = 0; i < steps; ++i) {
    const double most = megabyte * (200.0 + 400.0 * i / steps);
    const std::string where = fmt::format("{:.1f} MB", most / megabyte);
    const ProgramResult result = disturbed.run({.in_child = limited(RLIMIT_AS, most)});
    expect_clear(result, disturbed, where);
    outcomes[outcome(result, disturbed)]++;
    disturbed.expect_nothing_half(where);
  }
  disturbed.expect_rerun("with enough memory");
  tell("address space of 200 to 600 MB (ulimit -v)", GetParam().name, outcomes);
}

TEST_P(Limits, AClockThatJumpsChangesNothing) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  Disturbed disturbed(GetParam());
  const ProgramResult result = disturbed.run({.in_child = faulty_system("clock")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(disturbed.state(), "all of the result");
  tell("wall clock jumps by days", GetParam().name, {{outcome(result, disturbed), 1}});
  disturbed.expect_nothing_half("clock");
}

TEST_P(Limits, AFileSystemWithoutLocksIsWarnedOf) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  Disturbed disturbed(GetParam());
  std::map<std::string, int> outcomes;
  const auto run_with = [&](int error) {
    const ProgramResult result = disturbed.run({.in_child = faulty_system(fmt::format("locks:{}", error))});
    EXPECT_EQ(result.err.find("another process"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(std::strerror(error)), std::string::npos) << result.err;
    outcomes[outcome(result, disturbed)]++;
    return result;
  };
  for (const int error : {ENOLCK, EOPNOTSUPP, EINVAL, ENOSYS}) {
    const ProgramResult result = run_with(error);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(disturbed.state(), "all of the result");
    const std::size_t warning = result.err.find("has no locks");
    EXPECT_NE(warning, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("has no locks", warning + 1), std::string::npos) << result.err;
  }
  const ProgramResult result = run_with(EIO);
  EXPECT_EQ(result.exit_code, io_error) << result.err;
  EXPECT_NE(result.err.find("cannot be locked"), std::string::npos) << result.err;
  disturbed.expect_nothing_half("locks that fail");
  tell("no locks", GetParam().name, outcomes);
}

TEST_P(Limits, ASecondProcessAtTheSameOutput) {
  Disturbed disturbed(GetParam());
  std::mt19937 random(11);
  std::uniform_real_distribution<double> within(0.0, 1.0);
  std::map<std::string, int> outcomes;
  const int repeats = fault_repeats();
  for (int i = 0; i < repeats; ++i) {
    const std::chrono::duration<double> later(disturbed.seconds() * (i + within(random)) / repeats);
    const std::string where = fmt::format("a second process {:.3f} s later", later.count());
    disturbed.prepare();
    ProgramResult first;
    std::thread other([&] { first = disturbed.start(); });
    std::this_thread::sleep_for(later);
    const ProgramResult second = disturbed.start();
    other.join();
    EXPECT_TRUE(first.exit_code == 0 || second.exit_code == 0) << where << first.err << second.err;
    for (const ProgramResult* result : std::initializer_list<const ProgramResult*>{&first, &second}) {
      if (result->exit_code == 0) continue;
      EXPECT_TRUE(result->exit_code == io_error || result->exit_code == input_error)
          << where << ": " << result->exit_code << " " << result->err;
      const bool says_why = result->err.find("another process") != std::string::npos ||
                            result->err.find("already exists") != std::string::npos ||
                            result->err.find("still being recorded") != std::string::npos ||
                            result->err.find("was made by somebody else") != std::string::npos;
      EXPECT_TRUE(says_why) << where << ": " << result->err;
    }
    outcomes[fmt::format("{} of 2 refused", (first.exit_code != 0) + (second.exit_code != 0))]++;
    disturbed.expect_nothing_half(where);
    EXPECT_EQ(disturbed.state(), "all of the result") << where;
    disturbed.expect_rerun(where);
  }
  tell("a second process at the same output", GetParam().name, outcomes);
}

/// A bed that takes gigabytes.
fs::path folder_with_large_scene() {
  const fs::path folder = test_folder();
  write_file(
      folder / "large.toml",
      "[bed]\nsize = [16.0, 16.0]\ncells = [16000, 16000]\nsurface = { kind = \"noise\", wavelength = 0.0 "
      "}\n");
  return folder;
}

TEST(LimitedMemory, ASceneThatTakesMoreIsRefusedBeforeItIsTaken) {
  if (sanitized) GTEST_SKIP() << "a sanitizer takes an address space of its own";
  const fs::path folder = folder_with_large_scene();
  for (const __rlimit_resource resource : {RLIMIT_AS, RLIMIT_DATA}) {
    const ProgramResult result =
        run_program({"run", "large.toml"}, folder, {.in_child = limited(resource, 700 * megabyte)});
    EXPECT_EQ(result.exit_code, input_error) << result.err;
    for (const char* part :
         {"large.toml: bed.cells = [16000, 16000]", "GB of memory", "ulimit", "take fewer"})
      EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_LT(result.peak_memory, 300 * megabyte);
    EXPECT_FALSE(fs::exists(folder / "large.h5.part"));
  }
  tell("scene larger than the memory allowed (ulimit)", "run", 2, "exit code 2, nothing taken, no file");
}

TEST(LimitedMemory, AContainersLimitIsRespected) {
  if (!have_own_mounts()) GTEST_SKIP() << "nothing can be mounted here";
  const fs::path folder = folder_with_large_scene(), groups = folder / "groups";
  // The container's own group, whatever its path, is the topmost one, as Docker shows it.
  for (const char* version : {"1", "2"}) {
    fs::remove_all(groups);
    fs::create_directories(groups / "memory");
    const bool is_1 = *version == '1';
    const fs::path top = is_1 ? groups / "memory" : groups;
    write_file(top / (is_1 ? "memory.limit_in_bytes" : "memory.max"), "500000000\n");
    write_file(top / (is_1 ? "memory.usage_in_bytes" : "memory.current"), "100000000\n");
    write_file(folder / "cgroup", is_1 ? "5:cpu,memory:/docker/4711\n" : "0::/docker/4711\n");
    const auto in_container = [&] {
      mount(groups.c_str(), "/sys/fs/cgroup", nullptr, MS_BIND, nullptr);
      mount((folder / "cgroup").c_str(), fmt::format("/proc/{}/cgroup", getpid()).c_str(), nullptr, MS_BIND,
            nullptr);
    };
    const auto mounts_of_its_own = [&] {
      if (unshare(CLONE_NEWNS) == 0) in_container();
    };
    const ProgramResult result = run_program({"run", "large.toml"}, folder, {.in_child = mounts_of_its_own});
    EXPECT_EQ(result.exit_code, input_error) << version << result.err;
    EXPECT_NE(result.err.find("the control group (container or job) leaves 0.4 GB"), std::string::npos)
        << version << result.err;
  }
  tell("scene larger than the memory allowed (control groups 1 and 2)", "run", 2,
       "exit code 2, nothing taken, no file");
}

}  // namespace
}  // namespace sandstroke
