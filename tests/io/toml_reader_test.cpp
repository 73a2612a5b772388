#include "io/toml_reader.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace sandstroke {
namespace {

TomlReader toml_of(const std::string& text) { return TomlReader::from_text(text, "file.toml"); }

/// The sentence of the error that `act` throws.
template <class Act>
std::string error_of(const Act& act) {
  try {
    act();
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

#define EXPECT_SAYS(act, ...)                                                                           \
  do {                                                                                                  \
    const std::string said = error_of([&] { act; });                                                    \
    for (const std::string part : {__VA_ARGS__}) EXPECT_NE(said.find(part), std::string::npos) << said; \
  } while (false)

TEST(TomlReader, GivesValuesAndFallbacks) {
  const TomlReader toml =
      toml_of("a = 1.5\n[b]\nc = 2\nd = 'x'\ne = [1, 2.5]\nf = true\ng = [[1, 2], [3, 4]]\n");
  EXPECT_EQ(toml.number("a", 0.0), 1.5);
  EXPECT_EQ(toml.number("b.c", 0.0), 2.0);
  EXPECT_EQ(toml.integer("b.c", 0, 0, 9), 2);
  EXPECT_EQ(toml.number("b.none", 7.0), 7.0);
  EXPECT_EQ(toml.text("b.d", ""), "x");
  EXPECT_EQ(toml.numbers("b.e", {0.0, 0.0}), (std::vector<double>{1.0, 2.5}));
  EXPECT_EQ(toml.profile("a", {}), std::vector<double>{1.5});
  EXPECT_TRUE(toml.boolean("b.f", false));
  EXPECT_EQ(toml.points("b.g")[1][0], 3.0);
  EXPECT_EQ(toml.choice("b.d", 0, {"w", "x"}), 1);
  EXPECT_NO_THROW(toml.reject_unread());
}

TEST(TomlReader, ErrorsNameFileLineKeyValueAndRemedy) {
  const TomlReader toml =
      toml_of("\n[tool]\nradius = -1.0\nname = 3\nlist = [1, 'x']\nbad = nan\nkind = 'round'\n");
  EXPECT_SAYS(toml.number("tool.radius", 1.0, positive), "file.toml:3", "tool.radius", "-1", "above 0");
  EXPECT_SAYS(toml.text("tool.name", ""), "file.toml:4", "tool.name", "integer", "string");
  EXPECT_SAYS(toml.profile("tool.list", {}), "file.toml:5", "tool.list", "number");
  EXPECT_SAYS(toml.number("tool.bad", 1.0), "file.toml:6", "nan", "finite");
  EXPECT_SAYS(toml.choice("tool.kind", 0, {"flat", "sharp"}), "file.toml:7", "round", "flat, sharp");
  EXPECT_SAYS(toml.require("tool.absent"), "file.toml", "tool.absent", "missing");
  EXPECT_SAYS(toml.numbers("tool.list", {0.0, 0.0}), "number");
  EXPECT_SAYS(toml.integer("tool.radius", 0, 0, 5), "integer");
}

TEST(TomlReader, RejectsSyntaxErrorsWithTheirLine) {
  EXPECT_SAYS(toml_of("a = 1\nb = = 2\n"), "file.toml:2", "TOML");
}

/// Each part is a table within the one before: a hundred thousand of them overflowed the stack.
TEST(TomlReader, RejectsKeysOfManyParts) {
  const auto key = [](int parts, const std::string& part) {
    std::string dotted = part;
    for (int i = 1; i < parts; ++i) dotted += "." + part;
    return dotted;
  };
  for (const std::string word : {"a", "'#'", "\"\\\"=\"", " a\t"}) {
    EXPECT_NO_THROW(toml_of(key(16, word) + " = 1\n[b." + key(15, word) + "]\n"));
    EXPECT_SAYS(toml_of("x = 1\n" + key(100'000, word) + " = 1\n"), "file.toml:2", "more than 16 parts");
    EXPECT_SAYS(toml_of("[" + key(17, word) + "]\n"), "file.toml:1", "more than 16 parts");
    EXPECT_SAYS(toml_of("x = { y = 1, " + key(17, word) + " = 1 }\n"), "file.toml:1", "more than 16 parts");
    EXPECT_SAYS(toml_of("x = \"\"\"\n a\\\"\"\"\"\"\"\n" + key(17, word) + " = 1\n"), "file.toml:3",
                "more than 16 parts");
    EXPECT_SAYS(toml_of("").override_with(key(17, word) + "=1"), "--set", "more than 16 parts");
  }
  // Dots that belong to no key.
  const std::string dots = key(50, "a");
  EXPECT_NO_THROW(toml_of("# " + dots + "\nx = '" + dots + "' # " + dots + "\ny = '''\n" + dots + "\n'''\n"));
  EXPECT_NO_THROW(toml_of("x = [" + std::string(50 * 4, ' ').replace(0, 8, "1.0, 2.0") + "]\n"));
}

TEST(TomlReader, RejectsKeysNobodyReadAndSuggestsTheNearest) {
  const TomlReader toml = toml_of("[force]\nk_s = 1.0\nk_d = 2.0\n");
  toml.number("force.k_s", 0.0);
  toml.number("force.k_c", 0.0);
  EXPECT_SAYS(toml.reject_unread(), "file.toml:3", "force.k_d", "did you mean force.k_");
  const TomlReader section = toml_of("[frce]\nk_s = 1.0\n");
  section.number("force.k_s", 0.0);
  EXPECT_SAYS(section.reject_unread(), "file.toml:1", "frce");
}

TEST(TomlReader, OverridesAreValuesOrBareWordsAndNamedInErrors) {
  TomlReader toml = toml_of("[relaxation]\nlaw = 'paper'\n");
  toml.override_with("relaxation.law=isotropic");
  toml.override_with("relaxation.talus_angle=35");
  toml.override_with("bed.cells=[3, 4]");
  EXPECT_EQ(toml.text("relaxation.law", ""), "isotropic");
  EXPECT_EQ(toml.number("relaxation.talus_angle", 0.0), 35.0);
  EXPECT_EQ(toml.numbers("bed.cells", {0, 0})[1], 4.0);
  toml.override_with("relaxation.rate=-1");
  EXPECT_SAYS(toml.number("relaxation.rate", 1.0, positive), "--set relaxation.rate=-1", "above 0");
  EXPECT_SAYS(toml.override_with("nonsense"), "--set nonsense", "key=value");
  EXPECT_SAYS(toml.override_with("relaxation.law.deeper=1"), "relaxation.law.deeper=1", "not a table");
  toml.override_with("relaxation.tals=1");
  EXPECT_SAYS(toml.reject_unread(), "--set relaxation.tals=1", "unknown key");
}

TEST(TomlReader, ReadsArraysOfTables) {
  const TomlReader toml = toml_of("[[segment]]\nspeed = 1\n[[segment]]\nspeed = -2\nx = 1\n");
  const auto segments = toml.tables("segment");
  ASSERT_EQ(segments.size(), 2u);
  EXPECT_EQ(segments[0].number("speed", 0.0), 1.0);
  EXPECT_SAYS(segments[1].number("speed", 0.0, positive), "file.toml:4", "segment.speed");
  EXPECT_SAYS(toml.reject_unread(), "file.toml:5", "segment.x");
}

}  // namespace
}  // namespace sandstroke
