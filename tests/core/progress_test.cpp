#include "core/progress.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

namespace sandstroke {
namespace {

/// What goes to the log in the block.
class KeptLog {
 public:
  KeptLog() {
    const auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(text_);
    sink->set_pattern("%v");
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("kept", sink));
  }
  ~KeptLog() { spdlog::set_default_logger(before_); }
  std::string text() const { return text_.str(); }

 private:
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
  std::ostringstream text_;
};

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
