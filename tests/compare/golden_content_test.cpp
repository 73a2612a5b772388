#include "compare/golden_content.h"

#include <cmath>
#include <functional>

#include "core/error.h"
#include "core/machine.h"
#include "golden_fixture.h"
#include "io/input_kind.h"

namespace sandstroke {
namespace {

class GoldenContentTest : public Golden {
 protected:
  /// A golden.h5 that says what it wants of a bed whose changed block is given.
  void claim(double rows, double cols, double cell_size, double servo_rate, const HeightGrid& block) {
    Hdf5Writer file(folder / "golden/dune/golden.h5", output_kind(InputKind::golden));
    file.attribute("/", "format_version", 2.0);
    file.write("/scene", run.scene);
    file.make_group("/surface");
    file.attribute("/surface", "rows", rows);
    file.attribute("/surface", "cols", cols);
    file.attribute("/surface", "cell_size", cell_size);
    file.attribute("/surface", "initial_hash", "");
    file.write("/surface/change", block);
    file.attribute("/surface/change", "row", 0.0);
    file.attribute("/surface/change", "col", 0.0);
    file.make_group("/trace");
    file.attribute("/trace", "servo_rate", servo_rate);
    file.write("/trace/ticks", HeightGrid::Zero(7, 1));
    file.finish();
  }
};

TEST_F(GoldenContentTest, KeepsHeightsAndTraceToWithinHalfAQuantum) {
  write_golden(folder / "golden/dune", finished());
  const GoldenContent content = read_golden(entry());
  EXPECT_LE((content.change - (run.final - run.initial)).abs().maxCoeff(), 0x1p-31);
  const Hdf5Reader file(folder / "golden/dune/golden.h5");
  EXPECT_EQ(file.shape("/surface/change"), (std::vector<hsize_t>{6, 10})) << "only the cells that changed";
  ASSERT_TRUE(content.trace);
  const std::vector<TickRecord>& rows = *content.trace;
  ASSERT_EQ(rows.size(), SyntheticRun::ticks) << "every tick";
  EXPECT_TRUE(std::isnan(rows[1].level)) << "lifted";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const TickRecord& tick = run.trace[k];
    EXPECT_EQ(rows[k].time, tick.time);
    EXPECT_EQ(rows[k].contact, tick.contact);
    EXPECT_NEAR(rows[k].device_force.z(), tick.device_force.z(), 0x1p-18);
    EXPECT_NEAR(rows[k].depth, tick.depth, 0x1p-28);
  }
}

TEST_F(GoldenContentTest, KeepsEachFieldOfATickInItsPlace) {
  for (std::size_t k = 0; k < run.trace.size(); ++k) {
    const double number = 8.0 * static_cast<double>(k);
    TickRecord& tick = run.trace[k];
    tick.device_force = {number + 1.0, number + 2.0, number + 3.0};
    tick.depth = number + 4.0;
    tick.level = number + 5.0;
    tick.contact = k % 20 == 0;
  }
  write_golden(folder / "golden/dune", finished());
  const std::vector<TickRecord> rows = *read_golden(entry()).trace;
  ASSERT_EQ(rows.size(), run.trace.size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const TickRecord& tick = run.trace[k];
    EXPECT_EQ(rows[k].time, tick.time);
    EXPECT_EQ(rows[k].device_force, tick.device_force);
    EXPECT_EQ(rows[k].depth, tick.depth);
    EXPECT_EQ(rows[k].level, tick.level);
    EXPECT_EQ(rows[k].contact, tick.contact);
  }
}

TEST_F(GoldenContentTest, TimesOfTicksWithGapsAreKeptToTheBit) {
  run.scene = "[device]\nservo_rate = 3333.3\n";
  std::int64_t number = 0;
  for (std::size_t k = 0; k < run.trace.size(); ++k, number += k % 30 == 0 ? 1'000'000'007 : 1)
    run.trace[k].time = static_cast<double>(number) / 3333.3;
  write_golden(folder / "golden/dune", finished());
  const std::vector<TickRecord> rows = *read_golden(entry()).trace;
  ASSERT_EQ(rows.size(), run.trace.size());
  for (std::size_t k = 0; k < rows.size(); ++k) EXPECT_EQ(rows[k].time, run.trace[k].time);
}

TEST_F(GoldenContentTest, ATraceThatItCannotKeepIsRefused) {
  using Change = std::function<void(TickRecord&)>;
  for (const auto& [words, change] : std::vector<std::pair<std::string, Change>>{
           {"at time 0.05 s is not finite", [](TickRecord& tick) { tick.device_force.y() = std::nan(""); }},
           {"at time 0.05 s is not finite", [](TickRecord& tick) { tick.depth = -HUGE_VAL; }},
           {"at time 0.05 s is not finite", [](TickRecord& tick) { tick.level = std::nan(""); }},
           {"at time 0.05 s is not finite or too large", [](TickRecord& tick) { tick.level = 1e9; }},
           {"time 0.0504 s is not a whole multiple", [](TickRecord& tick) { tick.time = 0.0504; }}}) {
    run = SyntheticRun();
    change(run.trace[50]);
    try {
      write_golden(folder / "golden/dune", finished());
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

TEST_F(GoldenContentTest, AnEntryOfAnotherFormatSaysWhatToDo) {
  write_golden(folder / "golden/dune", finished());
  for (const auto& [version, words] :
       {std::pair{1.0,
                  "has format 1, and this program reads format 2; make it again with: sandstroke golden "
                  "update dune"},
        {3.0, "has format 3, and this program reads format 2; use a newer version"}}) {
    Hdf5Writer file(folder / "golden/dune/golden.h5", output_kind(InputKind::golden));
    file.attribute("/", "format_version", version);
    file.finish();
    EXPECT_NE(check_table(compare()).find(words), std::string::npos) << check_table(compare());
  }
}

TEST_F(GoldenContentTest, KeepsTheSmallestChange) {
  run.final(2, 3) = 2e-9;
  write_golden(folder / "golden/dune", finished());
  EXPECT_NEAR(read_golden(entry()).change(2, 3), 2e-9, 0x1p-31);
}

TEST_F(GoldenContentTest, ADamagedEntryIsNotBelieved) {
  write_golden(folder / "golden/dune", finished());
  const HeightGrid one = HeightGrid::Zero(1, 1), none = HeightGrid::Zero(0, 0);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = HUGE_VAL;
  claim(30, 40, 0.01, 1, one);
  EXPECT_NO_THROW(read_golden(entry()));
  for (const double side : {0.0, -1.0, 65537.0, nan}) {
    claim(side, 40, 0.01, 1, none);
    expect_only_failure("golden content", "does not lie in the bed");
    claim(30, side, 0.01, 1, none);
    expect_only_failure("golden content", "does not lie in the bed");
  }
  for (const double cell_size : {0.0, -0.01, nan, infinite}) {
    claim(30, 40, cell_size, 1, one);
    expect_only_failure("golden content", "cell_size");
  }
  for (const double servo_rate : {-1.0, 0.0, nan, infinite}) {
    claim(30, 40, 0.01, servo_rate, one);
    expect_only_failure("golden content", "servo_rate");
  }
}

TEST_F(GoldenContentTest, ASmallEntryOfAHugeBedIsRefusedBeforeItTakesMemory) {
  constexpr double side = BedGeometry::most_cells;
  if (memory_room().bytes > 4.0 * sizeof(double) * side * side) GTEST_SKIP() << "there is room for it";
  write_golden(folder / "golden/dune", finished());
  claim(side, side, 0.01, 1, HeightGrid::Zero(1, 1));
  EXPECT_THROW(read_golden(entry()), NotEnoughMemory);
  EXPECT_THROW(compare(), NotEnoughMemory) << "that says nothing about the run";
}

}  // namespace
}  // namespace sandstroke
