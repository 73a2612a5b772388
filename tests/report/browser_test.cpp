#include "browser.h"

namespace sandstroke {
namespace {

using Json = nlohmann::ordered_json;

// The driver itself: what pages are tested with must send what a person sends, and not pass over mishaps.

std::string page(const std::string& body) {
  return "<!DOCTYPE html><html><body>" + body +
         "<script>const log = []; const note = (event) => log.push([event.type, event.isTrusted, "
         "event.target.id]);"
         "document.documentElement.dataset.ready = 'true'</script></body></html>";
}

using Driver = BrowserTest;

TEST_F(Driver, ClicksAreRealAndReachWhatIsFarDownThePage) {
  browser().open_text(page("<p style='height: 5000px'></p><button id=b onclick='note(event)'>x</button>"));
  browser().click("#b");
  EXPECT_EQ(browser().evaluate("log"), Json({{"click", true, "b"}}));
}

TEST_F(Driver, WhatIsCoveredOrMissingCannotBeClicked) {
  browser().open_text(page("<button id=b>x</button><div style='position: fixed; inset: 0'></div>"));
  EXPECT_THROW(browser().click("#b"), std::runtime_error);
  EXPECT_THROW(browser().click("#c"), std::runtime_error);
}

TEST_F(Driver, KeysWalkTypeAndPress) {
  browser().open_text(page(R"(<input id=text><button id=b onclick='note(event)'>x</button>
    <select id=s onchange='note(event)'><option>one<option>two<option>three</select>)"));
  browser().press("Tab");
  browser().type("a 1=K");
  EXPECT_EQ(browser().evaluate("document.getElementById('text').value"), "a 1=K");
  browser().press("Tab");
  browser().press("Enter");
  browser().press("Space");
  browser().press("Tab");
  browser().press("Shift+Tab");
  EXPECT_EQ(browser().evaluate("document.activeElement.id"), "b");
  browser().choose("#s", "three");
  EXPECT_EQ(browser().evaluate("document.getElementById('s').value"), "three");
  EXPECT_EQ(browser().evaluate("log.filter(([type]) => type === 'click')"),
            Json({{"click", true, "b"}, {"click", true, "b"}}));
}

TEST_F(Driver, DragsASlider) {
  browser().open_text(page("<input id=r type=range min=0 max=100 value=50 style='width: 400px'>"));
  const Point middle = browser().centre("#r");
  browser().drag(middle, {middle.x + 90, middle.y});
  EXPECT_NEAR(browser().evaluate("Number(document.getElementById('r').value)"), 73, 2);
}

TEST_F(Driver, HoversOverAnElement) {
  browser().open_text(page("<button id=b>x</button>"));
  browser().hover("#b");
  EXPECT_EQ(browser().evaluate("document.getElementById('b').matches(':hover')"), true);
}

TEST_F(Driver, AwaitsPromisesAndConditions) {
  browser().open_text(page("<p>"));
  EXPECT_EQ(browser().evaluate("new Promise((done) => setTimeout(() => done([1, 'two', null]), 5))"),
            Json({1, "two", nullptr}));
  browser().evaluate("setTimeout(() => { window.late = true; }, 50), 0");
  browser().wait_for("window.late");
  EXPECT_EQ(browser().evaluate("window.late"), true);
}

TEST_F(Driver, ErrorsOfPagesAndExpressionsAreErrors) {
  browser().open_text(
      page("<script>setTimeout(() => { window.late = true; throw new Error('one') });"
           "console.error('two', 2); console.log('fine')</script><img src='missing.png'>"));
  browser().wait_for("window.late");
  browser().evaluate("0");
  const std::string all = Json(browser().errors()).dump();
  EXPECT_EQ(browser().errors().size(), 3u) << all;
  for (const char* text : {"Error: one", "two", "ERR_FILE_NOT_FOUND"})
    EXPECT_NE(all.find(text), std::string::npos) << all;
  EXPECT_THROW(browser().evaluate("nothing.at.all"), std::runtime_error);
  EXPECT_THROW(browser().evaluate("Promise.reject(new Error('no'))"), std::runtime_error);
  EXPECT_THROW(browser().wait_for("nothing.at.all"), std::runtime_error);
  browser().open_text(page("<p>"));
  EXPECT_TRUE(browser().errors().empty());
}

}  // namespace
}  // namespace sandstroke
