// A file's content when it was flushed can be read, wherever a kill comes after that, also into a flush.
#include <gtest/gtest.h>
#include <signal.h>
#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <sstream>

#include "faults/content.h"
#include "faults/faulted_command.h"
#include "hdf5/hdf5_file.h"
#include "sanitized.h"

namespace sandstroke {
namespace {

constexpr int flushes = 32, rows_per_flush = 700;

constexpr OutputKind kind{.name = "a file", .begin = hdf5_signature, .mark = "test", .header = 96};

/// Grows columns, and makes groups, attributes and chunks, as a run does; says after each flush that it was.
TEST(Flushes, DISABLED_Writer) {
  Hdf5Writer file("a.h5", kind);
  Hdf5Column numbers = file.column("/trace/number"), places = file.column("/trace/place", 3);
  for (int k = 0; k < flushes; ++k) {
    std::vector<double> rows;
    for (int i = 0; i < rows_per_flush; ++i) rows.push_back(k * rows_per_flush + i);
    numbers.append(rows.data(), rows.size());
    rows.resize(3 * rows_per_flush, k);
    places.append(rows.data(), rows_per_flush);
    const std::string name = fmt::format("/frame/{:06}", k);
    file.write(name + "/tiles", std::vector<std::uint32_t>(static_cast<std::size_t>(k), 1u));
    Hdf5Chunks chunks = file.chunks(name + "/heights", {100, 100}, {32, 32}, 0.0);
    chunks.write(32, 64, std::vector<double>(32 * 32, k).data());
    file.attribute(name, "time", 0.5 * k);
    file.attribute("/", "last", k);
    file.flush();
    if (write(STDOUT_FILENO, ".", 1) != 1) FAIL();
  }
  file.finish();
}

/// Makes the child run that test instead of the program.
std::function<void()> writer(const std::string& fault) {
  return [fault] {
    faulty_system(fault)();
    for (const char* name : {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX"}) unsetenv(name);
    execl("/proc/self/exe", "writer", "--gtest_also_run_disabled_tests",
          "--gtest_filter=Flushes.DISABLED_Writer", "--gtest_brief=1", nullptr);
  };
}

void expect_flushed(const std::filesystem::path& path, int flushed, const std::string& where) {
  const Hdf5Reader file(path);
  const std::vector<double> numbers = file.doubles("/trace/number");
  EXPECT_GE(numbers.size(), static_cast<std::size_t>(flushed) * rows_per_flush) << where;
  for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], static_cast<double>(i)) << where;
  EXPECT_EQ(file.vectors("/trace/place").size(), numbers.size()) << where;
  EXPECT_GE(file.number_attribute("/", "last"), flushed - 1) << where;
  for (int k = 0; k < flushed; ++k)
    EXPECT_EQ(file.grid(fmt::format("/frame/{:06}/heights", k))(40, 70), k) << where;
  EXPECT_TRUE(can_be_read(path)) << where;
}

TEST(Flushes, StandWhereverTheKillComes) {
  if (sanitized) GTEST_SKIP() << "a sanitizer must be loaded first, and so must be what fails";
  const std::filesystem::path folder = test_folder(), count = folder / "count";
  const std::filesystem::path whole = folder / "a.h5", part = folder / "a.h5.part";
  long calls = 0;
  ASSERT_EQ(chdir(folder.c_str()), 0);
  ASSERT_EQ(run_program({}, folder, {.in_child = writer("count:" + count.string())}).exit_code, 0);
  std::istringstream(read_file(count)) >> calls;
  ASSERT_GT(calls, 10 * flushes);
  const long some = std::min(calls, 20L * fault_repeats()), first = std::min(calls, 10L);
  std::map<std::string, int> outcomes;
  for (long i = 0; i < first + some; ++i) {  // all of the first, in which the file comes to be
    const long call = i < first ? 1 + i : 1 + (i - first) * calls / some;
    const std::string where = fmt::format("killed before call {} of {}", call, calls);
    std::filesystem::remove(whole);
    std::filesystem::remove(part);
    const ProgramResult killed = run_program({}, folder, {.in_child = writer(fmt::format("kill:{}", call))});
    EXPECT_EQ(killed.exit_code, 128 + SIGKILL) << where;
    const auto flushed = static_cast<int>(std::count(killed.out.begin(), killed.out.end(), '.'));
    const std::filesystem::path left = std::filesystem::exists(whole) ? whole : part;
    if (flushed > 0)
      expect_flushed(left, flushed, where);
    else
      EXPECT_NO_THROW(Hdf5Writer(whole, kind)) << where << ": begun anew";
    outcomes[fmt::format("{}", left == whole ? "whole" : flushed > 0 ? "readable" : "nothing flushed")]++;
  }
  tell("kill -9 between two calls that change a file, of a writer that flushes 32 times", "hdf5", outcomes);
}

}  // namespace
}  // namespace sandstroke
