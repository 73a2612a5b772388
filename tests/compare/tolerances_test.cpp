#include "compare/tolerances.h"

#include <gtest/gtest.h>

#include "compare/check.h"

namespace sandstroke {
namespace {

TEST(Tolerances, EachKeyIsListedOnceAndSetsItsOwnValue) {
  for (const ToleranceKey& key : tolerance_keys) {
    const Tolerances values = values_of(used_tolerances({{key.name, 0.125}}));
    for (const ToleranceKey& other : tolerance_keys)
      EXPECT_EQ(values.*other.value, std::string(key.name) == other.name ? 0.125 : Tolerances().*other.value)
          << key.name << ", " << other.name;
    EXPECT_TRUE(key.golden_range().contains(Tolerances().*key.value)) << key.name;
  }
}

TEST(Tolerances, AnOptionCountsBeforeTheFileAndThatBeforeTheDefault) {
  const std::vector<UsedTolerance> used =
      used_tolerances({{"force", 0.5}, {"depth", 0.25}}, {{"force", 2.0}, {"height", 4.0}}, "own.toml");
  const nlohmann::json json = to_json({"run", {}, used})["tolerances"];
  EXPECT_EQ(json, nlohmann::json::parse(R"([
    {"name": "height", "value": 4.0, "unit": "m", "source": "own.toml"},
    {"name": "force", "value": 0.5, "unit": "N", "source": "--force-tolerance"},
    {"name": "depth", "value": 0.25, "unit": "m", "source": "--depth-tolerance"},
    {"name": "pixel", "value": 2.0, "unit": "of 255", "source": "default"},
    {"name": "pixel_share", "value": 0.001, "unit": "", "source": "default"},
    {"name": "pixel_above", "value": 0.0, "unit": "of 255", "source": "default"}])"));
  EXPECT_EQ(changed_tolerances(used),
            "height 4 m (own.toml), force 0.5 N (--force-tolerance), depth 0.25 m (--depth-tolerance)");
  EXPECT_EQ(changed_tolerances(used_tolerances({})), "");
}

TEST(Tolerances, AreNotGivenWithoutAFile) { EXPECT_TRUE(read_tolerances("/nosuch/tolerances.toml").empty()); }

}  // namespace
}  // namespace sandstroke
