#include "core/progress.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "kept_log.h"

namespace sandstroke {
namespace {

TEST(Progress, IsToldWithoutATerminalOnceItTakesLong) {
  if (isatty(STDERR_FILENO)) GTEST_SKIP() << "the bar is drawn on the terminal";
  using namespace std::chrono_literals;
  const KeptLog log;
  Progress quick("run");
  quick.update(0.5);
  EXPECT_EQ(log.text(), "");
  Progress slow("run", 400ms);
  std::this_thread::sleep_for(400ms);
  slow.update(0.25);
  EXPECT_EQ(log.text().find("run: 25 %, "), 0) << log.text();
  const std::string once = log.text();
  slow.update(0.26);  // not before as much time has passed again
  EXPECT_EQ(log.text(), once);
  std::this_thread::sleep_for(1s);
  slow.count(7, "passes");
  EXPECT_NE(log.text().find("run: 7 passes after "), std::string::npos) << log.text();
}

}  // namespace
}  // namespace sandstroke
