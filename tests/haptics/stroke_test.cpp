#include "haptics/stroke.h"

#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace sandstroke {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Stroke three_samples() {
  Stroke stroke;
  stroke.time = {0.0, 0.01, 0.02};
  stroke.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  return stroke;
}

std::string complaint(const Stroke& stroke) {
  try {
    check_stroke(stroke, "hand.h5");
  } catch (const Error& failure) {
    EXPECT_EQ(failure.kind(), ErrorKind::input);
    return failure.what();
  }
  return "";
}

TEST(CheckStroke, AcceptsASoundStroke) { EXPECT_EQ(complaint(three_samples()), ""); }

TEST(CheckStroke, AcceptsOneSample) {
  Stroke stroke;
  stroke.time = {3.0};
  stroke.position = {{0, 0, 0}};
  EXPECT_EQ(complaint(stroke), "");
}

TEST(CheckStroke, NamesWhatIsWrongAndWhere) {
  EXPECT_THAT(complaint(Stroke{}), AllOf(HasSubstr("hand.h5"), HasSubstr("at least one")));

  Stroke stroke = three_samples();
  stroke.time[2] = 0.01;
  EXPECT_THAT(complaint(stroke),
              AllOf(HasSubstr("time of sample 2"), HasSubstr("0.01"), HasSubstr("increase")));

  stroke = three_samples();
  stroke.time[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("time of sample 1"), HasSubstr("not finite")));

  stroke = three_samples();
  stroke.position[1].y() = std::numeric_limits<double>::infinity();
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("position of sample 1"), HasSubstr("inf")));

  stroke = three_samples();
  stroke.pressure = {0.0, 1.0, std::numeric_limits<double>::infinity()};
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("pressure of sample 2"), HasSubstr("inf")));
  stroke.pressure.pop_back();
  EXPECT_THAT(complaint(stroke), HasSubstr("pressure has 2 rows"));

  stroke = three_samples();
  stroke.position[1].y() = 1e300;
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("position of sample 1"), HasSubstr("1e+300")));

  stroke = three_samples();
  stroke.velocity.assign(3, {0.0, 1e308, 0.0});
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("velocity of sample 0"), HasSubstr("1e+308")));

  stroke = three_samples();
  stroke.time = {-1e300, 0.0, 1e300};
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("time of sample 0"), HasSubstr("-1e+300")));

  stroke = three_samples();
  stroke.time = {0.0, 1e-102, 2e-102};  // a rate of 1e102 Hz
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("time of sample 1"), HasSubstr("1e-102")));

  stroke = three_samples();
  stroke.force.resize(2);
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("force has 2 rows"), HasSubstr("time has 3")));

  stroke = three_samples();
  stroke.contact = {1, 7, 1};
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("contact of sample 1"), HasSubstr("is 7")));

  stroke = three_samples();
  stroke.gap_threshold = 0.0;
  EXPECT_THAT(complaint(stroke), HasSubstr("gap_threshold"));

  stroke = three_samples();
  stroke.frame = "robot";
  EXPECT_THAT(complaint(stroke), AllOf(HasSubstr("frame"), HasSubstr("robot")));
}

TEST(CheckStroke, EveryColumnHasARowPerSample) {
  for (const std::size_t rows : {std::size_t{2}, std::size_t{4}}) {
    const auto complaint_about = [&](const auto& resize) {
      Stroke stroke = three_samples();
      resize(stroke);
      return complaint(stroke);
    };
    const std::string wrong = " has " + std::to_string(rows) + " rows";
    EXPECT_THAT(complaint_about([=](Stroke& s) {
                  s.position.resize(rows, {0, 0, 0});
                }),
                HasSubstr("position" + wrong));
    EXPECT_THAT(complaint_about([=](Stroke& s) {
                  s.velocity.resize(rows, {0, 0, 0});
                }),
                HasSubstr("velocity" + wrong));
    EXPECT_THAT(complaint_about([=](Stroke& s) {
                  s.force.resize(rows, {0, 0, 0});
                }),
                HasSubstr("force" + wrong));
    EXPECT_THAT(complaint_about([=](Stroke& s) { s.switches.resize(rows); }), HasSubstr("switches" + wrong));
    EXPECT_THAT(complaint_about([=](Stroke& s) { s.flags.resize(rows); }), HasSubstr("flags" + wrong));
    EXPECT_THAT(complaint_about([=](Stroke& s) { s.contact.resize(rows); }), HasSubstr("contact" + wrong));
  }
}

TEST(CheckStroke, ItsLimitsAreWhereItSays) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto accepts = [](const auto& set) {
    Stroke stroke = three_samples();
    set(stroke);
    return complaint(stroke).empty();
  };
  for (const double fraction : {0.95, 1.05}) {
    const bool more = fraction > 1.0;
    EXPECT_EQ(accepts([=](Stroke& s) { s.time[2] = fraction * 1e50; }), !more);
    EXPECT_EQ(accepts([=](Stroke& s) { s.time[0] = -fraction * 1e50; }), !more);
    EXPECT_EQ(accepts([=](Stroke& s) { s.position[1].z() = -fraction * 1e50; }), !more);
    EXPECT_EQ(accepts([=](Stroke& s) { s.time = {0.0, fraction * 1e-50, 1.0}; }), more);
  }
  for (const PenState contact : {pen_up, pen_down, pen_lifts}) {
    EXPECT_TRUE(accepts([=](Stroke& s) { s.contact = {1, contact, 1}; }));
  }
  EXPECT_FALSE(accepts([](Stroke& s) { s.contact = {1, 1, 3}; }));
  for (const double bad : {infinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(accepts([=](Stroke& s) { s.velocity.assign(3, {0, bad, 0}); }));
    EXPECT_FALSE(accepts([=](Stroke& s) { s.force.assign(3, {0, 0, bad}); }));
    EXPECT_FALSE(accepts([=](Stroke& s) { s.gap_threshold = bad; }));
    EXPECT_FALSE(accepts([=](Stroke& s) { s.nominal_rate = bad; }));
  }
  EXPECT_TRUE(accepts([](Stroke& s) { s.nominal_rate = 0.0; }));
  EXPECT_FALSE(accepts([](Stroke& s) { s.nominal_rate = -1e-9; }));
  EXPECT_TRUE(accepts([](Stroke& s) { s.frame = "device"; }));
}

TEST(PenState, SamplesAreJoinedWhereThePenStaysDown) {
  Stroke stroke;
  stroke.time = {0.0, 0.01, 0.02, 0.03, 0.04, 1.0};
  stroke.position.assign(6, Eigen::Vector3d::Zero());
  stroke.contact = {pen_down, pen_lifts, pen_down, pen_up, pen_down, pen_down};
  const std::vector<bool> joined = {true, false, false, false, false /* 0.96 s apart */, false /* last */};
  const std::vector<bool> touches = {true, true, true, false, true, true};
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    EXPECT_EQ(stroke.joined(i), joined[i]) << i;
    EXPECT_EQ(stroke.pen_down(i), touches[i]) << i;
  }
  stroke.contact.clear();
  EXPECT_TRUE(stroke.joined(1));
  EXPECT_FALSE(stroke.joined(4));
}

}  // namespace
}  // namespace sandstroke
