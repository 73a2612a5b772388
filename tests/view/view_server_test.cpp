// A server, and pages as it sees them: what they get, who is refused, and what hostile or slow ones do.
#include "view/view_server.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "view/view_client.h"

namespace sandstroke {
namespace {

constexpr int rows = 150, cols = 200;
constexpr double cell = 0.01;  // m

HeightField hilly(double shift = 0.0) {
  HeightGrid heights(rows, cols);
  for (int row = 0; row < rows; ++row)
    for (int col = 0; col < cols; ++col) heights(row, col) = 0.001 * row - 0.0005 * col + shift;
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

  /// The page has every cell as the bed has it.
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

  served.server.end("the time was up");
  page.hear_to_end();
  EXPECT_EQ(page.said.at("end"), "the time was up");
  EXPECT_EQ(page.close_code, 1000);
}

}  // namespace
}  // namespace sandstroke
