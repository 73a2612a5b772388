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

  /// Gives the window another size, until another page is opened [CSS pixels].
  void resize(int width, int height);

  /// Says that the reader prefers "light" or "dark" pages, until another page is opened.
  void prefer(const std::string& scheme);

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

/// A page as Chromium made it.
struct OpenedPage {
  std::string dom;                   ///< the document once it was drawn
  std::vector<std::string> console;  ///< Browser::errors()
  nlohmann::ordered_json answer;     ///< of the probe
};

/// A probe: [ready, charts, errors] as a page says itself.
inline const std::string page_state =
    "[document.documentElement.dataset.ready, Number(document.documentElement.dataset.charts),"
    " Number(document.documentElement.dataset.errors)]";

/// Tests that use pages: skipped where Chromium is not installed, but not in CI. One browser for all of them.
class BrowserTest : public ChromiumTest {
 protected:
  static void TearDownTestSuite() { browser_.reset(); }
  static Browser& browser() {
    if (!browser_) browser_ = std::make_unique<Browser>();
    return *browser_;
  }
  /// Opens the text of a page, and evaluates a JavaScript expression, the probe, in it.
  static OpenedPage open_page(const std::string& page, const std::string& probe = "null") {
    browser().open_text(page);
    OpenedPage opened;
    opened.answer = browser().evaluate(probe);
    opened.dom = browser().evaluate("document.documentElement.outerHTML");
    opened.console = browser().errors();
    return opened;
  }

 private:
  inline static std::unique_ptr<Browser> browser_;
};

}  // namespace sandstroke
