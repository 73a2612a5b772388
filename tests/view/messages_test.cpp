// Messages between server and page, byte by byte.
#include "view/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

namespace sandstroke {
namespace {

std::string bytes(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

TEST(ViewMessages, APictureIsItsBytes) {
  ViewState state;
  state.time = 2.0;
  state.tip = {1.0, -1.0, 0.5};
  state.force = {0.0, 2.0, -0.5};
  state.depth = 0.25;
  state.rate = 1000.0;
  state.lateness = 0.125;
  state.max_lateness = 4.0;
  state.orientation = {0.5, 0.5, 0.5, -0.5};  // w, x, y, z
  state.force_withheld = true;
  LiveBed::Tiles tiles;
  tiles.index = {258};
  tiles.heights.assign(BedGeometry::tile_area, 1.0f);
  tiles.heights.back() = -2.0f;
  std::string message = "what was there before";
  put_picture(state, tiles, false, message);
  ASSERT_EQ(message.size(), 80u + 4u + 4u * 4096u);
  EXPECT_EQ(message.substr(0, 16), "SAND" + bytes({1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x40}));
  EXPECT_EQ(message.substr(16, 12), bytes({0, 0, 0x80, 0x3f, 0, 0, 0x80, 0xbf, 0, 0, 0, 0x3f}));
  EXPECT_EQ(message.substr(28, 12), bytes({0, 0, 0, 0, 0, 0, 0, 0x40, 0, 0, 0, 0xbf}));
  EXPECT_EQ(message.substr(40, 16),
            bytes({0, 0, 0x80, 0x3e, 0, 0, 0x7a, 0x44, 0, 0, 0, 0x3e, 0, 0, 0x80, 0x40}));
  EXPECT_EQ(message.substr(56, 8), bytes({5, 0, 0, 0, 0, 0, 0, 0x3f}));
  EXPECT_EQ(message.substr(60, 20),
            bytes({0, 0, 0, 0x3f, 0, 0, 0, 0x3f, 0, 0, 0, 0xbf, 0, 0, 0, 0x3f, 0, 0, 0, 0}));
  EXPECT_EQ(message.substr(80, 8), bytes({2, 1, 0, 0, 0, 0, 0x80, 0x3f}));
  EXPECT_EQ(message.substr(message.size() - 8), bytes({0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0}));

  state.force_withheld = false;
  state.tip_known = true;
  state.depth = std::numeric_limits<double>::quiet_NaN();
  put_picture(state, {}, false, message);
  ASSERT_EQ(message.size(), 80u);
  EXPECT_EQ(message[56], 2);
  float depth;
  std::memcpy(&depth, &message[40], sizeof depth);
  EXPECT_TRUE(std::isnan(depth));
}

TEST(ViewMessages, TheSandOnTheToolEndsAPicture) {
  ViewState state;
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.5}, {1.0, 0.0, 0.5}, {0.0, -1.0, 0.25}};
  mesh.triangles = {{0, 2, 1}};
  state.load = std::make_shared<TriangleMesh>(mesh);
  std::string message;
  put_picture(state, {}, false, message);
  ASSERT_EQ(message.size(), 80u);  // a page that has it
  put_picture(state, {}, true, message);
  ASSERT_EQ(message.size(), 80u + 8u + 3u * 12u + 12u);
  EXPECT_EQ(message[56] & 8, 8);
  EXPECT_EQ(message.substr(80, 8), bytes({3, 0, 0, 0, 1, 0, 0, 0}));
  EXPECT_EQ(message.substr(112, 12), bytes({0, 0, 0, 0, 0, 0, 0x80, 0xbf, 0, 0, 0x80, 0x3e}));
  EXPECT_EQ(message.substr(124, 12), bytes({0, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0}));
  state.load.reset();  // it fell off
  put_picture(state, {}, true, message);
  EXPECT_EQ(message.substr(80), bytes({0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(ViewMessages, WhatIsSaidIsJson) {
  EXPECT_EQ(status_message("lift the \"tool\""), "{\"status\":\"lift the \\\"tool\\\"\"}");
  EXPECT_EQ(drawing_message(true), "{\"drawing\":true}");
  EXPECT_EQ(end_message("the time was up"), "{\"end\":\"the time was up\"}");
  ViewHello hello{"h\xff.h5", BedGeometry(3, 5, 0.5), {-1.0, 2.0}, ToolSettings{},
                  12.0,       PointerScale{1, 2, 3}};
  const nlohmann::json said = nlohmann::json::parse(hello_message(hello)).at("hello");
  EXPECT_EQ(said.at("title"), "h\uFFFD.h5");  // not UTF-8
  EXPECT_TRUE(said.at("bottom").is_null());
  hello.bottom = -0.25;
  EXPECT_EQ(nlohmann::json::parse(hello_message(hello)).at("hello").at("bottom"), -0.25);
  EXPECT_EQ(said.at("x0"), -1.0);
  EXPECT_EQ(said.at("y0"), -0.5);
  EXPECT_EQ(said.at("tile_side"), 64);
  EXPECT_EQ(said.at("tool").at("radius"), ToolSettings{}.radius);
  EXPECT_EQ(said.at("pointer"), (nlohmann::json{{"depth", 1.0}, {"radius", 2.0}, {"clearance", 3.0}}));
}

TEST(ViewMessages, AToolThatIsNoSphereComesAsItLies) {
  ToolSettings plate;
  plate.shape = ToolShape::plate;
  plate.orientation = {0.0, 0.0, 90.0};  // its width lies along x
  const auto said =
      nlohmann::json::parse(hello_message({"", BedGeometry(3, 5, 0.5), {}, plate, 0.0, {}})).at("hello");
  const auto& vertices = said.at("tool").at("vertices");
  ASSERT_EQ(vertices.size(), 3u * 8u);
  EXPECT_EQ(said.at("tool").at("triangles").size(), 12u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(std::abs(vertices[3 * i].get<double>()), 0.5 * plate.width, 1e-8);
    EXPECT_NEAR(std::abs(vertices[3 * i + 1].get<double>()), 0.5 * plate.thickness, 1e-8);
  }
  EXPECT_FALSE(nlohmann::json::parse(hello_message({"", BedGeometry(3, 5, 0.5), {}, {}, 0.0, {}}))
                   .at("hello")
                   .at("tool")
                   .contains("vertices"));
}

TEST(ViewMessages, PointerSamplesAreReadWholeOrNotAtAll) {
  const std::string one =
      bytes({0, 0, 0, 0, 0, 0, 0, 0x40, 0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0, 0x3f, 3, 0, 0, 1});
  ASSERT_EQ(one.size(), pointer_sample_bytes);
  const auto samples = pointer_samples(one + one);
  ASSERT_TRUE(samples);
  ASSERT_EQ(samples->size(), 2u);
  const PointerSample& last = samples->back();
  EXPECT_EQ(last.time, 2.0);
  EXPECT_EQ(last.x, 1.0f);
  EXPECT_EQ(last.y, -2.0f);
  EXPECT_EQ(last.pressure, 0.5f);
  EXPECT_EQ(last.switches, 0x01000003u);

  EXPECT_FALSE(pointer_samples(""));
  for (std::size_t size = 1; size < 2 * one.size(); ++size)
    EXPECT_EQ(pointer_samples((one + one).substr(0, size)).has_value(), size == one.size()) << size;
  std::string many;
  while (many.size() + one.size() <= most_message_bytes) many += one;
  EXPECT_TRUE(pointer_samples(many));
  EXPECT_FALSE(pointer_samples(many + one));
  for (const int field : {0, 8, 12, 16}) {  // no number
    std::string wrong = one;
    const double none = std::numeric_limits<double>::quiet_NaN();
    const float none_either = std::numeric_limits<float>::infinity();
    if (field == 0)
      std::memcpy(&wrong[0], &none, sizeof none);
    else
      std::memcpy(&wrong[static_cast<std::size_t>(field)], &none_either, sizeof none_either);
    EXPECT_FALSE(pointer_samples(one + wrong)) << field;
  }
}

}  // namespace
}  // namespace sandstroke
