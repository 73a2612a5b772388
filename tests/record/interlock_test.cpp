#include "record/interlock.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sandstroke {
namespace {

constexpr double clear_time = 0.05, tick = 1e-3;  // s
using Double = std::numeric_limits<double>;

/// An interlock and its time.
struct Timed {
  Interlock interlock{clear_time};
  double time = 5.0;

  void read(double force_due, double after = tick) {
    time += after;
    interlock.see(time, force_due);
  }
  void read_for(double seconds, double force_due) {
    for (const double end = time + seconds; time < end - 0.5 * tick;) read(force_due);
  }
};

enum State { in_the_sand, clearing, open };
State state_of(const Timed& timed) {
  if (timed.interlock.is_open()) return open;
  Timed later = timed;  // one that was clear for a while already opens sooner
  for (int i = 0; i < 50; ++i) later.read(0.0, 1.0005 * tick);
  return later.interlock.is_open() ? clearing : in_the_sand;
}

// Each state, and what comes of each event in it.
TEST(Interlock, WalksItsStateTable) {
  const auto in = [](State state) {
    Timed timed;
    timed.read(5.0);
    if (state == clearing) timed.read_for(0.5 * clear_time, 0.0);
    if (state == open) timed.read_for(2.0 * clear_time, 0.0);
    EXPECT_EQ(state_of(timed), state);
    return timed;
  };
  struct Event {
    std::string name;
    std::function<void(Timed&)> happens;
    State from_sand, from_clearing, from_open;
  };
  const std::vector<Event> events = {
      {"out of the sand", [](Timed& t) { t.read(0.0); }, clearing, clearing, open},
      {"for long", [](Timed& t) { t.read_for(2.0 * clear_time, 0.0); }, open, open, open},
      {"a little force", [](Timed& t) { t.read(0.19); }, clearing, clearing, open},
      {"a force", [](Timed& t) { t.read(0.21); }, in_the_sand, in_the_sand, open},
      {"a large force", [](Timed& t) { t.read(1e300); }, in_the_sand, in_the_sand, open},
      {"an endless force", [](Timed& t) { t.read(Double::infinity()); }, in_the_sand, in_the_sand, open},
      {"no number", [](Timed& t) { t.read(Double::quiet_NaN()); }, in_the_sand, in_the_sand, open},
      {"a short pause", [](Timed& t) { t.read(0.0, 0.024); }, clearing, clearing, open},
      {"a gap", [](Timed& t) { t.read(0.0, 0.026); }, clearing, clearing, clearing},
      {"a gap into the sand", [](Timed& t) { t.read(5.0, 0.026); }, in_the_sand, in_the_sand, in_the_sand},
      {"an hour", [](Timed& t) { t.read(5.0, 3600.0); }, in_the_sand, in_the_sand, in_the_sand},
      {"an error", [](Timed& t) { t.interlock.close(); }, in_the_sand, in_the_sand, in_the_sand},
  };
  for (const Event& event : events)
    for (const auto& [before, after] : {std::pair{in_the_sand, event.from_sand},
                                        {clearing, event.from_clearing},
                                        {open, event.from_open}}) {
      Timed timed = in(before);
      event.happens(timed);
      EXPECT_EQ(state_of(timed), after) << event.name << ", from " << before;
    }
}

TEST(Interlock, IsClosedAtFirst) {
  EXPECT_FALSE(Interlock(clear_time).is_open());
  EXPECT_EQ(Interlock(clear_time).open_for(), 0.0);
  Timed timed;
  timed.read_for(100.0, 12.0);
  EXPECT_FALSE(timed.interlock.is_open());
}

TEST(Interlock, OpensOnceTheToolWasOutForItsTimeWithoutInterruption) {
  Timed timed;
  for (int i = 0; i < 5; ++i) {
    timed.read_for(clear_time, 0.0);  // the last reading is a tick short of it after the first
    EXPECT_FALSE(timed.interlock.is_open());
    timed.read(1.0);
  }
  timed.read_for(clear_time, 0.0);
  EXPECT_FALSE(timed.interlock.is_open());
  timed.read(0.0, 1.1 * tick);
  EXPECT_TRUE(timed.interlock.is_open());
}

TEST(Interlock, CountsFromEachTimeItOpens) {
  Timed timed;
  for (int opening = 0; opening < 3; ++opening) {
    while (!timed.interlock.is_open()) timed.read(0.0);
    EXPECT_EQ(timed.interlock.open_for(), 0.0);
    timed.read_for(0.3, 5.0);
    EXPECT_NEAR(timed.interlock.open_for(), 0.3, 1e-9);
    timed.interlock.close();
    EXPECT_EQ(timed.interlock.open_for(), 0.0);
  }
}

}  // namespace
}  // namespace sandstroke
