#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "real_client.h"
#include "sanitized.h"
#include "test_folder.h"

namespace sandstroke {

/// Starts headless Chromium. The pages are ours and read nothing else: no sandbox, which root (as in CI)
/// could not have; WebGL is drawn by the processor. To it come --user-data-dir, --window-size and what is to
/// be done.
inline const std::string chromium_command =
    "chromium --headless --no-sandbox --disable-gpu --enable-unsafe-swiftshader --disable-dev-shm-usage "
    "--disable-quic --no-first-run "
    "--disable-background-networking --disable-component-update --disable-sync";

/// A page as headless Chromium made it.
struct OpenedPage {
  std::string dom;                   ///< the document once it had settled
  std::vector<std::string> console;  ///< what scripts and browser wrote to the console
  nlohmann::ordered_json answer;     ///< of the probe
};

/// A probe: [ready, charts, errors] as a page says itself.
inline const std::string page_state =
    "[document.documentElement.dataset.ready, Number(document.documentElement.dataset.charts),"
    " Number(document.documentElement.dataset.errors)]";

/// Opens a page and asks it: `probe` is a JavaScript expression, evaluated once the page's scripts ran; its
/// value comes back as JSON. It sees what the scripts declared.
inline OpenedPage open_in_chromium(const std::string& page, const std::string& probe = "null") {
  const TestFolder folder;
  std::ofstream(folder / "page.html")
      << page << "<script>document.documentElement.dataset.answer = encodeURIComponent(JSON.stringify("
      << probe << "))</script>\n";
  // Virtual time runs until nothing is left to do, at most so many milliseconds.
  const std::string at = folder.path().string();
  const std::string command =
      "timeout 1200 " + chromium_command +
      " --window-size=1200,4000 --virtual-time-budget=10000 --enable-logging=stderr --user-data-dir='" + at +
      "/profile' --dump-dom 'file://" + at + "/page.html' > '" + at + "/dom' 2> '" + at + "/log'";
  OpenedPage opened;
  EXPECT_EQ(std::system(command.c_str()), 0) << "Chromium did not end well";
  std::ostringstream dom;
  dom << std::ifstream(folder / "dom").rdbuf();
  opened.dom = dom.str();
  std::ifstream log(folder / "log");
  for (std::string line; std::getline(log, line);)
    if (line.find("CONSOLE") != std::string::npos && line.find("GL Driver Message") == std::string::npos)
      opened.console.push_back(line);  // not that it is slow to draw on the processor

  const std::string name = "data-answer=\"";
  const std::size_t begin = opened.dom.find(name), end = opened.dom.find('"', begin + name.size());
  if (begin == std::string::npos || end == std::string::npos) {
    ADD_FAILURE() << "the page did not answer the probe: " << probe;
    return opened;
  }
  std::string text;
  for (std::size_t i = begin + name.size(); i < end; ++i)
    if (opened.dom[i] == '%') {
      text += static_cast<char>(std::stoi(opened.dom.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      text += opened.dom[i];
    }
  opened.answer = nlohmann::ordered_json::parse(text, nullptr, false);
  return opened;
}

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
