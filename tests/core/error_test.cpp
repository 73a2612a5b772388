#include "core/error.h"

#include <gtest/gtest.h>

namespace sandstroke {
namespace {

std::string said(const std::string& quoted) {
  try {
    throw_input_error("a.gcode:3: '{}' is no word; correct it", quoted);
  } catch (const Error& failure) {
    return failure.what();
  }
}

TEST(Error, ItsSentenceIsWholeWhateverItQuotes) {
  EXPECT_EQ(said(std::string("X\0Y", 3)), "a.gcode:3: 'X\\x00Y' is no word; correct it");
  EXPECT_EQ(said("\x1B[2J"), "a.gcode:3: '\\x1b[2J' is no word; correct it");
  EXPECT_EQ(said("X\nsandstroke: done"), "a.gcode:3: 'X\\x0asandstroke: done' is no word; correct it");
  EXPECT_EQ(said("\xFF"), "a.gcode:3: '\\xff' is no word; correct it");
  EXPECT_EQ(said("µ\t\\x00"), "a.gcode:3: 'µ\t\\x00' is no word; correct it") << "nothing is escaped twice";
}

}  // namespace
}  // namespace sandstroke
