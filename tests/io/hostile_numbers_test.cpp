// Numbers that nobody means, for every key of a scene that takes numbers: each is read as what it says, or
// refused in a sentence.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "core/error.h"
#include "io/scene_keys.h"
#include "io/scene_toml.h"
#include "io/toml_reader.h"

namespace sandstroke {
namespace {

/// The number of times that numbers were read, and refused.
struct Outcomes {
  int read = 0, refused = 0;
};

/// The value of a key in a scene as text.
std::vector<double> numbers_in(const std::string& scene, const std::string& key) {
  return TomlReader::from_text(scene, "written.toml").profile(key, {});
}

/// Reads a scene with this setting.
void try_setting(const std::string& base, const std::string& key, const std::string& literal, int count,
                 Outcomes& outcomes) {
  std::string value = literal;
  for (int i = 1; i < count; ++i) value += ", " + literal;
  const std::string setting = key + "=" + (count > 1 ? "[" + value + "]" : value);
  SCOPED_TRACE(base + setting);
  try {
    const SceneFile scene = scene_from_text(base, "scene.toml", {setting});
    const double meant = std::strtod(literal.c_str(), nullptr);
    for (const double number : numbers_in(scene_text(scene), key))
      EXPECT_LT(std::abs(number - meant), 1e-300);
    ++outcomes.read;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
    EXPECT_NE(std::string(error.what()).find(key.substr(0, key.find('.'))), std::string::npos)
        << error.what();
    ++outcomes.refused;
  }
}

TEST(HostileNumbers, AreReadAsWhatTheySayOrRefused) {
  const char* const literals[] = {"1e308",
                                  "-1e308",
                                  "9007199254740992",
                                  "9007199254740993",
                                  "nan",
                                  "-inf",
                                  "-0.0",
                                  "-9223372036854775808",
                                  "1e-320",
                                  "0.5",
                                  "2147483648",
                                  "9223372036854775807"};
  Outcomes outcomes;
  for (const char* surface : {"flat", "cone", "noise", "ripples", "file"}) {
    const std::string base = std::string("[model]\npreset = 'accurate'\n[bed.surface]\nkind = '") + surface +
                             "'\n" + (surface == std::string("file") ? "file = 'a.h5'\n" : "") +
                             "[device]\nmodel = 'dynamic'\n[stroke]\nfile = 'line.toml'\n"
                             "[[stone]]\ncentre = [0.0, 0.0, 0.0]\n[[sand.region]]\ntalus_angle = 30.0\n";
    const std::string written = scene_text(scene_from_text(base, "scene.toml"));
    for (const KeySection& section : all_scene_keys())
      for (const KeyRow& key : section.keys) {
        if (!TomlReader::from_text(written, "written.toml").has(key.name)) continue;
        const bool takes_numbers = key.value.find_first_of("\"tf") == key.value.npos && !key.value.empty();
        if (!takes_numbers) continue;
        const int count = static_cast<int>(numbers_in(written, key.name).size());
        for (const char* literal : literals) try_setting(base, key.name, literal, count, outcomes);
      }
  }
  EXPECT_GT(outcomes.read, 100);
  EXPECT_GT(outcomes.refused, 100);
}

TEST(HostileNumbers, AWholeNumberThatNoDoubleIsIsSaidToBeSo) {
  for (const char* number : {"9007199254740993", "-9007199254740993", "9223372036854775807"}) {
    try {
      scene_from_text("", "scene.toml", {std::string("device.offset=[0, 0, ") + number + "]"});
      ADD_FAILURE() << number;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(),
                fmt::format("--set device.offset=[0, 0, {0}]: device.offset is {0}, but whole numbers are "
                            "exact only up to 2^53 = "
                            "9007199254740992; give a smaller one, or write it with a decimal point",
                            number));
    }
  }
  const Scene scene =
      scene_from_text("", "scene.toml", {"device.offset=[9007199254740992, 0, 9007199254740993.0]"});
  EXPECT_EQ(scene.device.offset.x(), 0x1p53);
  EXPECT_EQ(scene.device.offset.z(), 0x1p53);
}

TEST(HostileNumbers, WavesAreNotSmallerThanPlacesInTheBed) {
  for (const char* kind : {"noise", "ripples"}) {
    const std::string base = std::string("[bed.surface]\nkind = '") + kind + "'\n";
    EXPECT_THROW(scene_from_text(base, "scene.toml", {"bed.surface.wavelength=1e-16"}), Error) << kind;
    EXPECT_NO_THROW(scene_from_text(base, "scene.toml", {"bed.surface.wavelength=1e-15"})) << kind;
  }
}

}  // namespace
}  // namespace sandstroke
