#include "record/start_gate.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

using enum Awaited;

TEST(StartGate, OpensAtOnceWhereNothingIsAsked) {
  EXPECT_TRUE(StartSettings{}.at_once());
  EXPECT_EQ(StartGate({}, 0, 20).see(0, 0, true), nothing);
  EXPECT_FALSE((StartSettings{1.0, {}, false}.at_once()));
  EXPECT_FALSE((StartSettings{0.0, 0, false}.at_once()));
  EXPECT_FALSE((StartSettings{0.0, {}, true}.at_once()));
}

TEST(StartGate, CountsDown) {
  StartGate gate({1.0, {}, false}, 100, 20);
  EXPECT_EQ(gate.see(0, 0, true), countdown);
  EXPECT_EQ(gate.see(99, 0, false), countdown);
  EXPECT_EQ(gate.see(100, 0, true), nothing);
}

TEST(StartGate, WaitsForAPress) {
  StartGate gate({0.0, 3, false}, 0, 20);
  EXPECT_EQ(gate.see(0, 8, false), start_switch) << "held down from before";
  EXPECT_EQ(gate.see(10, 0, false), start_switch);
  EXPECT_EQ(gate.see(20, 7, false), start_switch) << "others";
  EXPECT_EQ(gate.see(30, 8, false), start_switch);
  EXPECT_EQ(gate.see(40, 8, false), start_switch);
  EXPECT_EQ(gate.see(50, 8, false), nothing);
}

TEST(StartGate, WaitsForContactFromAbove) {
  StartGate gate({0.0, {}, true}, 0, 20);
  EXPECT_EQ(gate.see(0, 0, true), lift);
  EXPECT_EQ(gate.see(1, 0, true), lift);
  EXPECT_EQ(gate.see(2, 0, false), contact);
  EXPECT_EQ(gate.see(3, 0, false), contact);
  EXPECT_EQ(gate.see(4, 0, true), nothing);
}

TEST(StartGate, WaitsForOneAfterTheOther) {
  StartGate gate({1.0, 0, true}, 100, 0);
  EXPECT_EQ(gate.see(0, 0, false), countdown);
  EXPECT_EQ(gate.see(50, 1, true), countdown);
  EXPECT_EQ(gate.see(100, 1, false), start_switch) << "pressed too early";
  EXPECT_EQ(gate.see(110, 0, false), start_switch);
  EXPECT_EQ(gate.see(120, 1, true), lift) << "was out of the sand too early";
  EXPECT_EQ(gate.see(130, 0, false), contact) << "the switch counts once";
  EXPECT_EQ(gate.see(140, 0, true), nothing);
}

}  // namespace
}  // namespace sandstroke
