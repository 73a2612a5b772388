#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "real_client.h"
#include "sanitized.h"

namespace sandstroke {

/// Starts headless Chromium. The pages are ours and read nothing else: no sandbox, which root (as in CI)
/// could not have; WebGL is drawn by the processor. To it come --user-data-dir, --window-size and what is to
/// be done.
inline const std::string chromium_command =
    "chromium --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --disable-dev-shm-usage "
    "--disable-quic --no-first-run "
    "--disable-background-networking --disable-component-update --disable-sync";

/// Tests that look at pages: skipped under sanitizers, and where Chromium is not installed, but then not in
/// CI.
class ChromiumTest : public testing::Test {
 protected:
  void SetUp() override {
    if (sanitized) GTEST_SKIP() << "no sanitizer sees what pages do";
    SANDSTROKE_NEEDS(std::system("command -v chromium > /dev/null") == 0, "chromium");
  }
};

}  // namespace sandstroke
