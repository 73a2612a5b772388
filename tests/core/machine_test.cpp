#include "core/machine.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cmath>

#include "core/error.h"
#include "core/output_file.h"
#include "test_folder.h"

namespace sandstroke {
namespace {

namespace fs = std::filesystem;

class ControlGroups : public testing::Test {
 protected:
  void say(const fs::path& group, const std::string& file, const std::string& text) {
    fs::create_directories(mount / group);
    put_text(mount / group / file, text);
  }
  double room(const std::string& groups) { return control_group_room(groups, mount.path()); }

  TestFolder mount;
};

TEST_F(ControlGroups, NoneIsNoLimit) {
  EXPECT_TRUE(std::isinf(room("")));
  EXPECT_TRUE(std::isinf(room("0::/\n")));
  EXPECT_TRUE(std::isinf(room("0::/some/where\n4:memory:/else\nno group\n")));
  say("", "memory.max", "max\n");
  say("memory", "memory.limit_in_bytes", "9223372036854771712\n");
  EXPECT_TRUE(std::isinf(room("0::/\n4:memory:/\n")));
}

TEST_F(ControlGroups, TheTightestOnTheWayUpCountsLessWhatIsTakenAndNotCached) {
  say("job/step", "memory.max", "1000\n");
  say("job/step", "memory.current", "400\n");
  say("job/step", "memory.stat", "anon 100\nactive_file 50\ninactive_file 150\n");
  EXPECT_EQ(room("0::/job/step\n"), 800.0);
  say("job", "memory.max", "700\n");
  say("job", "memory.current", "600\n");
  EXPECT_EQ(room("0::/job/step\n"), 100.0);
  EXPECT_EQ(room("0::/job\n"), 100.0);
  EXPECT_TRUE(std::isinf(room("0::/other\n")));
}

TEST_F(ControlGroups, VersionOneSaysItInItsOwnWords) {
  say("memory/job", "memory.limit_in_bytes", "1000\n");
  say("memory/job", "memory.usage_in_bytes", "900\n");
  say("memory/job", "memory.stat", "active_file 1\ntotal_active_file 200\ntotal_inactive_file 100\n");
  EXPECT_EQ(room("12:cpu,cpuacct:/\n5:hugetlb,memory:/job\n0::/\n"), 400.0);
  // A container sees its own group as the topmost, and is told its path outside.
  say("memory", "memory.limit_in_bytes", "300\n");
  EXPECT_EQ(room("5:memory:/docker/4711\n"), 300.0);
}

TEST(Memory, MoreThanThereIsIsRefusedWithWhoAllowsHowMuch) {
  const MemoryRoom room = memory_room();
  EXPECT_GT(room.bytes, 0.0);
  EXPECT_LE(room.bytes, physical_memory() * 10.0);  // with swap
  EXPECT_NO_THROW(check_memory(1.0, "a grain", "take none"));
  try {
    check_memory(1e18, "a desert", "take a smaller one");
    FAIL();
  } catch (const Error& refused) {
    EXPECT_EQ(refused.kind(), ErrorKind::input);
    const std::string sentence = refused.what();
    for (const char* part : {"a desert takes about 1e+09 GB of memory", "GB", "take a smaller one"})
      EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  }
}

TEST(MemoryDeathTest, MoreAddressesThanTheLimitLeavesAreRefused) {
  EXPECT_NO_THROW(check_addresses(1e15, "a desert", ""));  // where there is no limit
  EXPECT_EXIT(
      {
        rlimit limit{};
        limit.rlim_cur = limit.rlim_max = 1'000'000'000'000'000;  // more than a sanitizer maps
        setrlimit(RLIMIT_AS, &limit);
        check_addresses(5e14, "a dune", "");
        try {
          check_addresses(2e15, "a desert", "take a smaller one");
        } catch (const Error& refused) {
          const std::string sentence = refused.what();
          const bool said = sentence.starts_with("a desert takes about 2e+06 GB of address space, but ") &&
                            sentence.ends_with(" GB; take a smaller one");
          _exit(said && refused.kind() == ErrorKind::input ? 0 : 1);
        }
        _exit(2);
      },
      testing::ExitedWithCode(0), "");
}

TEST(DiskDeathTest, MoreThanThereIsRoomForIsRefusedWithWhatToDo) {
  const TestFolder folder;
  EXPECT_NO_THROW(check_disk(folder / "a.h5", 1.0, ""));
  EXPECT_NO_THROW(check_disk("a.h5", 1.0, "")) << "in this folder";
  const auto refusal = [&](double bytes) -> std::string {
    try {
      check_disk(folder / "a.h5", bytes, "keep less");
    } catch (const Error& refused) {
      return refused.kind() == ErrorKind::io ? refused.what() : "of another kind";
    }
    return "";
  };
  for (const char* part : {"a.h5: takes about 1e+12 GB, but the disk has room for", "GB; keep less"})
    EXPECT_NE(refusal(1e21).find(part), std::string::npos) << refusal(1e21);
  EXPECT_EXIT(
      {
        rlimit limit{};
        limit.rlim_cur = limit.rlim_max = 2'000'000;
        setrlimit(RLIMIT_FSIZE, &limit);
        if (!refusal(2'000'000).empty()) _exit(1);
        _exit(refusal(2'000'001).find("(ulimit -f) is 0.002 GB; keep less") == std::string::npos);
      },
      testing::ExitedWithCode(0), "");
}

TEST(Disk, WhatAnEarlierTryTookIsFree) {
  const TestFolder folder;
  struct statvfs disk = {};
  ASSERT_EQ(statvfs(folder.path().c_str(), &disk), 0);
  const double free = static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
  write_text_file(folder / "a.h5.part", "");
  fs::resize_file(folder / "a.h5.part", 100'000'000'000);  // with a hole: it takes nothing
  EXPECT_NO_THROW(check_disk(folder / "a.h5", free + 0.9e11, ""));
  EXPECT_THROW(check_disk(folder / "b.h5", free + 0.9e11, ""), Error);
}

}  // namespace
}  // namespace sandstroke
