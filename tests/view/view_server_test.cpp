// A server, and pages as it sees them: what they get, who is refused, and what hostile or slow ones do.
#include "view/view_server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <thread>

#include "view/view_client.h"

namespace sandstroke {
namespace {

constexpr int rows = 150, cols = 200;
constexpr double cell = 0.01;  // m

HeightField hilly() {
  HeightGrid heights(rows, cols);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) heights(row, col) = 0.001 * row - 0.0005 * col;
  return {heights, cell};
}

class Taker : public PointerSink {
 public:
  void take(std::span<const PointerSample> samples) override { taken += static_cast<int>(samples.size()); }
  void leave() override { ++left; }
  std::atomic<int> taken = 0, left = 0;
};

struct Served {
  explicit Served(PointerSink* pointer = nullptr, const ViewLimits& limits = {})
      : server({live,
                state,
                {"hand.h5", bed, height_range(bed), ToolSettings{}, 12.0,
                 pointer ? std::optional(PointerScale{0.01, 0.02, 0.03}) : std::nullopt},
                "<!DOCTYPE html>\nthe page",
                pointer},
               limits) {}
  HeightField bed = hilly();
  LiveBed live{bed};
  LiveState state;
  ViewServer server;
  std::string address = server.address();
  int port = server.port();
  std::string query = "?token=" + token_of_address(address);

  /// Every cell is so much higher than at the start.
  void raise(double by) {
    for (int row = 0; row < rows; ++row)
      for (int col = 0; col < cols; ++col) bed.set(row, col, 0.001 * row - 0.0005 * col + by);
    live.publish(bed);
  }
  /// The page has the last cell, or every one, as the bed has it.
  bool shows_last(const ViewClient& page) const {
    return page.height(rows - 1, cols - 1) == static_cast<float>(bed(rows - 1, cols - 1));
  }
  bool shows(const ViewClient& page) const {
    for (int row = 0; row < rows; ++row)
      for (int col = 0; col < cols; ++col)
        if (page.height(row, col) != static_cast<float>(bed(row, col))) return false;
    return true;
  }
};

constexpr std::size_t all_tiles = 3 * 4;

template <class Condition>
void wait_until(const Condition& condition) {
  while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(ViewServer, GivesThePageToWhoKnowsTheToken) {
  const Served served;
  for (const std::string name : {"127.0.0.1", "localhost"}) {
    const std::string host = name + ":" + std::to_string(served.port);
    for (const bool with_origin : {false, true}) {
      std::map<std::string, std::string> fields = {{"Host", host}};
      if (with_origin) fields["Origin"] = "http://" + host;
      const HttpAnswer answer = http_get(served.port, "/" + served.query, fields);
      EXPECT_EQ(answer.status, 200);
      EXPECT_EQ(answer.body, "<!DOCTYPE html>\nthe page");
      EXPECT_EQ(answer.fields.at("Cache-Control"), "no-store");
      EXPECT_EQ(answer.fields.at("Referrer-Policy"), "no-referrer");
      EXPECT_EQ(answer.fields.at("X-Content-Type-Options"), "nosniff");
      EXPECT_TRUE(answer.fields.at("Content-Security-Policy").starts_with("default-src 'none'; "));
      EXPECT_EQ(answer.fields.count("Access-Control-Allow-Origin"), 0u);
    }
  }
}

TEST(ViewServer, RefusesWhoDoesNotBelongHere) {
  const Served served;
  std::string wrong = served.query;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  for (const std::string path : {"/", "/live", "/favicon.ico"}) {
    for (const std::string& query : {std::string(), std::string("?token="), wrong, served.query + "0"})
      EXPECT_EQ(http_get(served.port, path + query).status, 403) << path << query;
    for (const std::string origin : {"http://evil.example", "null", "https://127.0.0.1", "http://127.0.0.1"})
      EXPECT_EQ(http_get(served.port, path + served.query, {{"Origin", origin}}).status, 403) << origin;
    for (const std::string host : {"evil.example", "127.0.0.1", "evil.example:1", ""})
      EXPECT_EQ(http_get(served.port, path + served.query, {{"Host", host}}).status, 403) << host;
  }
  EXPECT_EQ(http_get(served.port, "/else" + served.query).status, 404);
  EXPECT_EQ(http_get(served.port, "/" + served.query, {}, "POST").status, 405);
  EXPECT_EQ(http_get(served.port, "/live" + served.query).status, 426);
  EXPECT_THROW(ViewClient(served.address, {{"Origin", "http://evil.example"}}), std::exception);
}

TEST(ViewServer, EveryServerHasATokenOfItsOwn) {
  const Served one, other;
  EXPECT_EQ(token_of_address(one.address).size(), 32u);
  EXPECT_NE(token_of_address(one.address), token_of_address(other.address));
}

TEST(ViewServer, APageGetsTheBedAndThenWhatChanges) {
  Served served;
  ViewClient page(served.address);
  ASSERT_TRUE(page.hear_until([&] { return page.tiles.size() == all_tiles; }));
  const nlohmann::json& hello = page.said.at("hello");
  EXPECT_EQ(hello.at("title"), "hand.h5");
  EXPECT_EQ(hello.at("rows"), rows);
  EXPECT_EQ(hello.at("cols"), cols);
  EXPECT_EQ(hello.at("cell_size"), cell);
  EXPECT_EQ(hello.at("x0"), served.bed.x_of(0));
  EXPECT_EQ(hello.at("y0"), served.bed.y_of(0));
  EXPECT_EQ(hello.at("low"), -0.0005 * (cols - 1));
  EXPECT_EQ(hello.at("high"), 0.001 * (rows - 1));
  EXPECT_TRUE(hello.at("pointer").is_null());
  EXPECT_TRUE(served.shows(page));

  served.bed.set(70, 130, 0.5);  // tile (1, 2)
  served.live.publish(served.bed);
  ViewState state;
  state.time = 1.5;
  state.tip = {0.1, 0.2, 0.3};
  state.tip_known = true;
  served.state.publish(state);
  served.state.say("lift the tool");
  const int before = page.pictures;
  ASSERT_TRUE(page.hear_until([&] { return page.height(70, 130) == 0.5f && page.picture->time == 1.5; }));
  EXPECT_LE(page.pictures - before, 2);  // bed and state are published apart
  ASSERT_TRUE(page.hear_until([&] { return page.said.contains("status"); }));
  EXPECT_EQ(page.said.at("status"), "lift the tool");
  EXPECT_EQ(page.picture->flags, 2u);
  EXPECT_EQ(page.picture->tip[2], 0.3f);
  EXPECT_TRUE(served.shows(page));

  std::jthread ending([&] { served.server.end("the time was up"); });
  page.hear_to_end();
  EXPECT_EQ(page.said.at("end"), "the time was up");
  EXPECT_EQ(page.close_code, 1000);
}

TEST(ViewServer, AReaderThatStallsGetsTheNewestLaterAndHarmsNobody) {
  Served served;
  ViewClient stalled(served.address), reading(served.address);
  ASSERT_TRUE(stalled.hear_until([&] { return stalled.tiles.size() == all_tiles; }));
  // Far more than the system keeps for a connection: 12 tiles of 16 kB, 40 times.
  for (int turn = 1; turn <= 40; ++turn) {
    served.raise(turn);
    ASSERT_TRUE(reading.hear_until([&] { return !reading.tiles.empty() && served.shows_last(reading); }));
  }
  EXPECT_EQ(served.server.pages(), 2);
  const int before = stalled.pictures;
  ASSERT_TRUE(stalled.hear_until([&] { return served.shows_last(stalled); }));
  EXPECT_TRUE(served.shows(stalled));
  EXPECT_LT(stalled.pictures - before, 20);  // what lay in the system, and the newest; not all of them
}

TEST(ViewServer, AThousandConnectionsAreRefusedAndThePageGoesOn) {
  ViewLimits limits;
  limits.silence = 60.0;  // so that they do not go by themselves
  Served served(nullptr, limits);
  std::optional<ViewClient> page(std::in_place, served.address);
  ASSERT_TRUE(page->hear_until([&] { return page->tiles.size() == all_tiles; }));
  {
    std::vector<SilentConnection> crowd;
    int refused = 0;
    while (crowd.size() < 1000) crowd.emplace_back(served.port);
    for (std::size_t i = crowd.size() - 900; i < crowd.size(); ++i) {
      const std::string said = crowd[i].hear_to_end();
      refused += said.empty() || said.starts_with("HTTP/1.1 503");
    }
    EXPECT_EQ(refused, 900);
    served.bed.set(0, 0, 9.0);
    served.live.publish(served.bed);
    EXPECT_TRUE(page->hear_until([&] { return page->height(0, 0) == 9.0f; }));
  }
  for (HttpAnswer answer; answer.status != 200;) answer = http_get(served.port, "/" + served.query);
  ViewClient another(served.address);
  EXPECT_TRUE(another.hear_until([&] { return another.tiles.size() == all_tiles; }));
  EXPECT_TRUE(served.shows(another));
}

TEST(ViewServer, MorePagesThanMayWatchAreToldSo) {
  ViewLimits limits;
  limits.pages = 2;
  Served served(nullptr, limits);
  std::optional<ViewClient> one(std::in_place, served.address), other(std::in_place, served.address);
  EXPECT_EQ(http_get(served.port, "/live" + served.query,
                     {{"Upgrade", "websocket"},
                      {"Connection", "Upgrade"},
                      {"Sec-WebSocket-Version", "13"},
                      {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="}})
                .status,
            503);
  one.reset();
  wait_until([&] { return served.server.pages() < 2; });
  EXPECT_NO_THROW(ViewClient(served.address));
}

TEST(ViewServer, WhoSaysNothingIsClosed) {
  ViewLimits limits;
  limits.silence = 0.05;
  const Served served(nullptr, limits);
  SilentConnection silent(served.port), slow(served.port);
  slow.send("GET / HTTP/1.1\r\nHost: ");
  EXPECT_EQ(silent.hear_to_end(), "");
  EXPECT_EQ(slow.hear_to_end(), "");
}

TEST(ViewServer, RequestsThatAreTooLongOrNoneAreClosed) {
  const Served served;
  for (const std::string& bytes : {"GET / HTTP/1.1\r\nX: " + std::string(20'000, 'x') + "\r\n\r\n",
                                   std::string("\x16\x03\x01\x02garbage\r\n\r\n"),
                                   "GET /" + std::string(20'000, 'x') + " HTTP/1.1\r\n\r\n",
                                   std::string("GET / HTTP/1.1\r\nContent-Length: 99999999\r\n\r\n")}) {
    SilentConnection hostile(served.port);
    hostile.send(bytes);
    const std::string said = hostile.hear_to_end();
    EXPECT_FALSE(said.starts_with("HTTP/1.1 200")) << said;
  }
  EXPECT_EQ(http_get(served.port, "/" + served.query).status, 200);
}

TEST(ViewServer, APageThatSendsGarbageIsClosedAndTheOthersGoOn) {
  Taker taker;
  Served served(&taker);
  ViewClient other(served.address);
  const std::string sample(24, '\0');
  for (const auto& [bytes, text] : {std::pair(std::string(23, 'x'), false),
                                    {std::string(), false},
                                    {std::string(24, '\xff'), false},
                                    {sample, true},
                                    {"{}", true},
                                    {std::string(std::size_t{1} << 20, '\0'), false}}) {
    ViewClient hostile(served.address);
    ASSERT_TRUE(hostile.hear());
    hostile.send(bytes, text);
    hostile.hear_to_end();
  }
  wait_until([&] { return served.server.pages() == 1; });
  EXPECT_EQ(taker.taken, 0);
  EXPECT_TRUE(other.hear_until([&] { return other.tiles.size() == all_tiles; }));
}

TEST(ViewServer, WhoOnlyWatchesMayNotDraw) {
  Served served;
  ViewClient page(served.address);
  page.point(0.0, 0.0f, 0.0f, 1.0f);
  page.hear_to_end();
  wait_until([&] { return served.server.pages() == 0; });
}

TEST(ViewServer, TheFirstPageThatDrawsIsTheHandUntilItGoes) {
  Taker taker;
  Served served(&taker);
  std::optional<ViewClient> one(std::in_place, served.address);
  ViewClient other(served.address);
  EXPECT_TRUE(one->hear());
  EXPECT_EQ(one->said.at("hello").at("pointer").at("depth"), 0.01);
  other.point(1.0, 0.0f, 0.0f, 0.0f);  // hovers
  one->point(1.0, 0.0f, 0.0f, 0.5f);   // draws
  ASSERT_TRUE(one->hear_until([&] { return one->said.contains("drawing"); }));
  ASSERT_TRUE(other.hear_until([&] { return other.said.contains("drawing"); }));
  EXPECT_EQ(one->said.at("drawing"), true);
  EXPECT_EQ(other.said.at("drawing"), false);
  wait_until([&] { return taker.taken == 1; });
  other.point(2.0, 0.0f, 0.0f, 1.0f);
  one->point(2.0, 0.0f, 0.0f, 0.0f);  // lifted, it still is the hand
  wait_until([&] { return taker.taken == 2; });
  EXPECT_EQ(taker.left, 0);
  one->vanish();
  wait_until([&] { return taker.left == 1; });
  other.point(3.0, 0.0f, 0.0f, 1.0f);
  ASSERT_TRUE(other.hear_until([&] { return other.said.at("drawing") == true; }));
  wait_until([&] { return taker.taken == 3; });
  one.emplace(served.address);  // opened again: it watches
  ASSERT_TRUE(one->hear_until([&] { return one->said.contains("drawing"); }));
  EXPECT_EQ(one->said.at("drawing"), false);
}

TEST(ViewServer, APageThatOnlyFinishesIsHeard) {
  Taker taker;
  const Served served(&taker);
  ViewClient page(served.address);
  page.point(1.0, 0.0f, 0.0f, 0.0f);  // hovers: that is of no page's hand
  page.point(2.0, 0.0f, 0.0f, 0.0f, 1u << PointerSample::finish_switch);
  wait_until([&] { return taker.taken == 1; });
}

TEST(ViewServer, EndsThoughAPageTakesNothing) {
  auto served = std::make_unique<Served>(nullptr, ViewLimits{.end = 0.5});
  ViewClient stalled(served->address);
  std::vector<SilentConnection> silent;
  for (int i = 0; i < 5; ++i) silent.emplace_back(served->port);
  wait_until([&] { return served->server.pages() == 1; });
  for (int turn = 0; turn < 20; ++turn) {
    served->raise(turn);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  served->server.end("the time was up");
  served.reset();
  EXPECT_EQ(silent.front().hear_to_end(), "");
}

}  // namespace
}  // namespace sandstroke
