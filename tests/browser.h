#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "chromium.h"
#include "test_folder.h"

namespace sandstroke {

/// A place in the window, from its upper left corner, in CSS pixels.
struct Point {
  double x = 0.0, y = 0.0;
};

/// Headless Chromium with a page that is used as a person uses it: by real events of mouse and keyboard,
/// which the browser sends where they belong. Spoken to in the Chrome DevTools Protocol over pipes. Whatever
/// goes wrong throws std::runtime_error, and so fails the test; also when an answer takes over a minute.
class Browser {
 public:
  Browser();  ///< starts it, with a window of 1200 x 900
  ~Browser();
  Browser(const Browser&) = delete;

  /// Opens a page, which is a file or the text of one, in a fresh window that remembers nothing of pages
  /// before, and waits until it says that it is drawn: <html data-ready="true">.
  void open(const std::filesystem::path& file);
  void open_text(const std::string& page);
  /// The same for a page that a server has.
  void open_address(const std::string& address);

  /// The window's picture, as a PNG file's bytes.
  std::string screenshot();

  /// The value of a JavaScript expression, as JSON; a promise is awaited. What scripts declared is in sight.
  nlohmann::ordered_json evaluate(const std::string& expression);
  /// Waits until a JavaScript expression holds.
  void wait_for(const std::string& condition);

  /// The middle of the element that a CSS selector names first, once it is scrolled into sight.
  Point centre(const std::string& selector);

  // The mouse. An element is met in its middle, and must not lie under another one.
  void click(const std::string& selector) { click(centre(selector)); }
  void click(Point at);
  void hover(const std::string& selector) { hover(centre(selector)); }
  void hover(Point at);
  /// Drags in this number of steps; rate: how many a second, as a hand does; 0: at once.
  void drag(Point from, Point to, int steps = 8, double rate = 0.0);

  // The keyboard, at what has the focus.
  /// One key: a character, or by name as in KeyboardEvent.key (Tab, Enter, ArrowDown, Space, ...); after
  /// "Shift+" or "Control+" with that held down.
  void press(const std::string& key);
  void type(const std::string& text);
  /// Chooses the option of this text in the select element of a CSS selector.
  void choose(const std::string& selector, const std::string& text);

  /// Errors since the page was opened: uncaught ones, those logged by its scripts and by the browser.
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  nlohmann::ordered_json call(const std::string& method,
                              const nlohmann::ordered_json& parameters = nlohmann::ordered_json::object());
  nlohmann::ordered_json next_message();
  void note_event(const nlohmann::ordered_json& event);
  void mouse(const char* type, Point at, int buttons);

  const TestFolder folder_;
  pid_t process_ = 0;
  int to_browser_ = -1, from_browser_ = -1;
  std::string read_;  ///< what of messages was read and not yet taken
  int last_id_ = 0;
  std::string context_, target_, session_;  ///< of the open page
  bool loaded_ = false;
  std::vector<std::string> errors_;
};

/// Tests that use pages: skipped where Chromium is not installed, but not in CI. One browser for all of them.
class BrowserTest : public ChromiumTest {
 protected:
  static void TearDownTestSuite() { browser_.reset(); }
  static Browser& browser() {
    if (!browser_) browser_ = std::make_unique<Browser>();
    return *browser_;
  }

 private:
  inline static std::unique_ptr<Browser> browser_;
};

}  // namespace sandstroke
