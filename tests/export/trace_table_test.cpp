#include "export/trace_table.h"

#include <gtest/gtest.h>

#include <sstream>

namespace sandstroke {
namespace {

TEST(TraceTable, HasAColumnForEveryNumberOfEveryField) {
  TickRecord tick;
  tick.time = 1.0 / 3.0;
  tick.hand.position = {1.1, 2.2, 3.3};
  tick.device_position = {-1.1, -2.2, -3.3};
  tick.device_force = {0.1, 0.2, 0.3};
  tick.repulse_force = {0.4, 0.5, 0.6};
  tick.drag_force = {0.7, 0.8, 0.9};
  tick.depth = 1e-300;
  tick.displaced_volume = 5e-8;
  tick.passivity_margin = -3.5;
  tick.contact = true;
  std::ostringstream file;
  write_csv(file, trace_table({tick, TickRecord{}}));
  std::istringstream lines(file.str());
  std::string header, first, second, none;
  std::getline(lines, header);
  std::getline(lines, first);
  std::getline(lines, second);
  EXPECT_EQ(header,
            "time [s],hand_position_x [m],hand_position_y [m],hand_position_z [m],device_position_x [m],"
            "device_position_y [m],device_position_z [m],device_force_x [N],device_force_y [N],"
            "device_force_z [N],repulse_force_x [N],repulse_force_y [N],repulse_force_z [N],drag_force_x [N],"
            "drag_force_y [N],drag_force_z [N],level [m],depth [m],displaced_volume [m^3],"
            "passivity_margin [N s/m],contact,saturated");
  EXPECT_TRUE(header.starts_with(trace_output.begin));
  EXPECT_NE(header.find(trace_output.mark), std::string::npos);
  // The level is not known: an empty field. Digits that read back to the same number.
  EXPECT_EQ(first,
            "0.3333333333333333,1.1,2.2,3.3,-1.1,-2.2,-3.3,0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,,1e-300,5e-08,"
            "-3.5,1,0");
  EXPECT_EQ(second, "0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,,0,0,0,0,0");
  EXPECT_FALSE(std::getline(lines, none));
}

TEST(TraceTable, HasWhatNotEveryRunHasWhereThisOneHasIt) {
  const auto columns = [](const TraceContent& content) {
    return trace_table({TickRecord{}}, content).columns.size();
  };
  EXPECT_EQ(columns({}), 22u);
  EXPECT_EQ(columns({.recorded_force = true}), 25u);
  EXPECT_EQ(columns({.recorded_force = true, .dropped_ticks = true}), 26u);
  EXPECT_EQ(columns({.asked_depth = true}), 23u);
}

}  // namespace
}  // namespace sandstroke
