#include "core/nearest_name.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

TEST(NearestName, IsOneThatGoesOnOrTheOneWithTheFewestEdits) {
  const std::set<std::string> known = {"bench", "convert", "force.k_d", "force.k_s", "run"};
  EXPECT_EQ(nearest_name("conv", known), "convert");
  EXPECT_EQ(nearest_name("force.ks", known), "force.k_s");
  EXPECT_EQ(nearest_name("rnu", known), "run");
  EXPECT_EQ(nearest_name("strawberries", known), "");
  EXPECT_EQ(nearest_name("run", known), "");
  EXPECT_EQ(nearest_name("force", known), "");  // not a name of another part
  EXPECT_EQ(nearest_name("run", {}), "");
}

TEST(NearestName, IsAKeyOfWhichOnlyTheLastPartIsRight) {
  const std::set<std::string> known = {"bed", "device.scale", "rate", "relaxation.talus_angle",
                                       "stroke.scale"};
  EXPECT_EQ(nearest_name("talus_angle", known), "relaxation.talus_angle");
  EXPECT_EQ(nearest_name("sand.talus_angle", known), "relaxation.talus_angle");
  EXPECT_EQ(nearest_name("scale", known), "device.scale or stroke.scale");
  EXPECT_EQ(nearest_name("segment.rate", known), "rate");
  EXPECT_EQ(nearest_name("angle", known), "");  // not a whole part
}

}  // namespace
}  // namespace sandstroke
