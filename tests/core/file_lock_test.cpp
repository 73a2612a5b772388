#include "core/file_lock.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "core/temporary_folder.h"

namespace sandstroke {
namespace {

TEST(FileLock, OneHoldsItOrManyShareIt) {
  const TemporaryFolder folder;
  {
    const auto held = FileLock::try_take(folder / "a");
    EXPECT_TRUE(held);
    EXPECT_FALSE(FileLock::try_take(folder / "a"));
    EXPECT_FALSE(FileLock::try_share(folder / "a"));
  }
  const auto one = FileLock::try_share(folder / "a"), another = FileLock::try_share(folder / "a");
  EXPECT_TRUE(one && another);
  EXPECT_FALSE(FileLock::try_take(folder / "a"));
}

TEST(FileLock, WaitsForThoseWhoLook) {
  const TemporaryFolder folder;
  FileLock::wait_and_take(folder / "a");
  auto looking = FileLock::try_share(folder / "a");
  std::atomic<bool> still_looking = true;
  std::thread waiting([&] {
    const FileLock taken = FileLock::wait_and_take(folder / "a");
    EXPECT_FALSE(still_looking);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // for the other to come to its lock
  still_looking = false;
  looking.reset();
  waiting.join();
}

}  // namespace
}  // namespace sandstroke
