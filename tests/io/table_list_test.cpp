#include <gtest/gtest.h>

#include "core/error.h"
#include "io/key_reader.h"
#include "io/key_table.h"
#include "io/toml_path.h"

namespace sandstroke {
namespace {

/// A list of tables in the file, and one within a section.
struct Post {
  int shape = 0;
  double radius = 1.0, width = 2.0, height = 3.0;
};
struct Garden {
  std::vector<Post> posts, rails;
};

void show_post(KeyVisitor& v, Post& post) {
  v.choice("shape", post.shape, {"round", "square"}, "its shape");
  if (post.shape == 0) v.number("radius", post.radius, positive, "m", "its radius");
  if (post.shape == 1) v.number("width", post.width, positive, "m", "its width");
  v.require("height");
  v.number("height", post.height, positive, "m", "its height");
}

void show_garden(KeyVisitor& v, Garden& garden) {
  show_tables(v, "post", garden.posts, "a post", show_post);
  show_tables(v, "fence.rail", garden.rails, "a rail", show_post);
}

std::vector<KeySection> all_garden_keys() {
  return all_keys([](KeyVisitor& v) {
    Garden garden{{{}}, {{}}};
    show_garden(v, garden);
  });
}

Garden garden_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  TomlReader toml = TomlReader::from_text(text, "garden.toml");
  for (const std::string& one : overrides) toml.override_with(one);
  Garden garden;
  read_keys(toml, [&](KeyVisitor& v) { show_garden(v, garden); });
  toml.reject_unread([] { return conditions(all_garden_keys()); });
  return garden;
}

std::string error_in(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    garden_of(text, overrides);
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "no error";
}

const std::string two_posts =
    "[[post]]\nheight = 4.0\n[[post]]\nshape = 'square'\nwidth = 5.0\nheight = 6.0\n";

TEST(TableList, EachTableIsReadInOrder) {
  const Garden garden = garden_of(two_posts + "[[fence.rail]]\nheight = 7.0\n");
  ASSERT_EQ(garden.posts.size(), 2u);
  EXPECT_EQ(garden.posts[0].shape, 0);
  EXPECT_EQ(garden.posts[0].radius, 1.0);
  EXPECT_EQ(garden.posts[0].height, 4.0);
  EXPECT_EQ(garden.posts[1].width, 5.0);
  EXPECT_EQ(garden.posts[1].height, 6.0);
  ASSERT_EQ(garden.rails.size(), 1u);
  EXPECT_EQ(garden.rails[0].height, 7.0);
}

TEST(TableList, MayBeMissingOrEmptyOrInOneLine) {
  EXPECT_TRUE(garden_of("").posts.empty());
  EXPECT_TRUE(garden_of("post = []\n").posts.empty());
  EXPECT_EQ(garden_of("post = [{height = 4.0}, {height = 5.0}]\n").posts[1].height, 5.0);
  EXPECT_EQ(garden_of("", {"fence.rail=[{height = 4.0}]"}).rails[0].height, 4.0);
}

TEST(TableList, OverridesNameATableByItsPlace) {
  EXPECT_EQ(garden_of(two_posts, {"post.1.radius=0.5"}).posts[0].radius, 0.5);
  EXPECT_EQ(garden_of(two_posts, {"post.2.width=0.5"}).posts[1].width, 0.5);
  EXPECT_EQ(garden_of(two_posts, {"!post.2.width"}).posts[1].width, 2.0);
  EXPECT_TRUE(garden_of(two_posts, {"!post"}).posts.empty());
  EXPECT_EQ(garden_of(two_posts, {"post=[{height = 4.0}]", "post.1.height=8"}).posts[0].height, 8.0);
}

TEST(TableList, OverridesOfATableThatIsNotThereSayHowManyThereAre) {
  EXPECT_EQ(error_in(two_posts, {"post.3.height=1"}),
            "--set post.3.height=1: garden.toml has 2 [[post]] tables, counted from 1, and no post.3");
  for (const std::string place : {"0", "00", "99999999999999999999999"})
    EXPECT_NE(error_in(two_posts, {"post." + place + ".height=1"}).find("and no post." + place),
              std::string::npos);
  EXPECT_EQ(error_in("", {"post.1.height=1"}),
            "--set post.1.height=1: post has no table in garden.toml; add one that begins with [[post]]");
  EXPECT_EQ(error_in("", {"fence.rail.1.height=1"}),
            "--set fence.rail.1.height=1: fence.rail has no table in garden.toml; add one that begins with "
            "[[fence.rail]]");
  EXPECT_EQ(error_in(two_posts, {"post.height=1"}),
            "--set post.height=1: post is a list of tables in garden.toml; say which one, as post.1.height");
  EXPECT_EQ(error_in(two_posts, {"post.2=1"}),
            "--set post.2=1: post.2 is a table; set one of its keys, as post.2.KEY=value");
  EXPECT_NE(error_in(two_posts, {"post.2.height.x=1"}).find("post.2.height is not a table"),
            std::string::npos);
  EXPECT_EQ(error_in(two_posts, {"!post.1"}),
            "--unset post.1: would give the tables behind it other numbers; take the table out of "
            "garden.toml, or take out its keys, as post.1.KEY");
  EXPECT_NE(error_in(two_posts, {"!post.3"}).find("garden.toml has no such key"), std::string::npos);
  EXPECT_NE(error_in(two_posts, {"!post.1.width"}).find("garden.toml has no such key"), std::string::npos);
}

TEST(TableList, WhatIsNotAListIsSaidToBeSo) {
  EXPECT_EQ(error_in("\npost = 3\n"), "garden.toml:2: post is an integer; write [[post]] tables");
  EXPECT_EQ(error_in("\n[post]\nheight = 1.0\n"),
            "garden.toml:2: post is one table; write [[post]], with two brackets");
  EXPECT_EQ(error_in("post = [{height = 1.0}, 3]\n"),
            "garden.toml:1: post is an array; write [[post]] tables");
  EXPECT_EQ(error_in("[fence]\nrail = 'x'\n"),
            "garden.toml:2: fence.rail is a string; write [[fence.rail]] tables");
  EXPECT_EQ(error_in("\n[[fence]]\nx = 1\n"),
            "garden.toml:2: fence.rail is not found: 'fence' is a list of tables; write [fence]");
  EXPECT_EQ(error_in("[fence]\nrale = 'x'\n"),
            "garden.toml:2: unknown key fence.rale; did you mean fence.rail?");
}

TEST(TableList, ErrorsNameThePlaceAndTheLine) {
  EXPECT_EQ(error_in("[[post]]\nheight = 4.0\n\n[[post]]\n"),
            "garden.toml:4: post.2.height is missing; add it");
  EXPECT_EQ(error_in("[[post]]\nheight = 4.0\n[[post]]\nheight = 0.0\n"),
            "garden.toml:4: post.2.height is 0; give a number above 0");
  EXPECT_EQ(error_in(two_posts, {"post.2.height=0"}),
            "--set post.2.height=0: post.2.height is 0; give a number above 0");
  EXPECT_EQ(
      error_in(two_posts + "radius = 1.0\n"),
      "garden.toml:7: post.2.radius applies only where post.2.shape is round; remove it, or change that "
      "setting");
  EXPECT_EQ(error_in(two_posts + "witdh = 1.0\n"),
            "garden.toml:7: unknown key post.2.witdh; did you mean post.2.width?");
  EXPECT_EQ(error_in(two_posts, {"post.2.heigth=1"}),
            "--set post.2.heigth=1: unknown key post.2.heigth; did you mean post.2.height?");
}

TEST(TableList, KeysOfAllTablesAreListedWithTheirPlaces) {
  Garden garden = garden_of(two_posts);
  const auto sections = listed_keys([&](KeyVisitor& v) { show_garden(v, garden); });
  ASSERT_EQ(sections.size(), 2u);
  EXPECT_EQ(sections[1].header(), "[[post]]");
  EXPECT_EQ(sections[1].keys[1].name, "post.2.width");
  EXPECT_EQ(sections[1].keys[1].value, "5.0");
}

TEST(TableList, HelpHasTheKeysOfOneTable) {
  const auto sections = all_garden_keys();
  ASSERT_EQ(sections.size(), 2u);
  EXPECT_EQ(sections[1].header(), "[[fence.rail]]");
  std::vector<std::string> names;
  for (const KeyRow& key : sections[1].keys) names.push_back(key.name);
  EXPECT_EQ(names, (std::vector<std::string>{"fence.rail.1.shape", "fence.rail.1.radius",
                                             "fence.rail.1.width", "fence.rail.1.height"}));
  EXPECT_EQ(conditions(sections)["fence.rail.1.width"], "fence.rail.1.shape is square");
  EXPECT_NE(key_table(sections).find("[[fence.rail]]  a rail"), std::string::npos);
}

TEST(TomlPath, NamesTheFirstTableAndBack) {
  EXPECT_EQ(at_first_places("post.12.radius"), "post.1.radius");
  EXPECT_EQ(at_first_places("fence.rail.3.part.4.x"), "fence.rail.1.part.1.x");
  EXPECT_EQ(at_first_places("tool.radius"), "tool.radius");
  EXPECT_EQ(at_places_of("post.12.radius", "post.1.shape is round and post.1.x"),
            "post.12.shape is round and post.12.x");
  EXPECT_EQ(at_places_of("a.3.b.4.x", "a.1.b.1.y"), "a.3.b.4.y");
  EXPECT_EQ(at_places_of("tool.radius", "tool.shape is sphere"), "tool.shape is sphere");
}

}  // namespace
}  // namespace sandstroke
