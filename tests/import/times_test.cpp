#include <gmock/gmock-matchers.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "import/import_stroke.h"
#include "import/time_stamp.h"

namespace sandstroke {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// x_m,y_m with these times.
ImportedStroke timed(const std::vector<std::string>& times, const std::string& name = "t",
                     const TableSettings& settings = {}) {
  std::string text = name + ";x_m;y_m\n";
  for (const std::string& time : times) text += time + ";0;" + std::to_string(text.size()) + "\n";
  return import_stroke_text(text, "in.csv", settings);
}

std::string refusal_of(const std::vector<std::string>& times) {
  try {
    timed(times, "t_ms");
  } catch (const Error& failure) {
    return failure.what();
  }
  return "";
}

TEST(TableTimes, StampsOf19DigitsKeepTheirDifferences) {
  const ImportedStroke ns = timed({"1700000000123456789", "1700000000123456790", "1700000001123456789"});
  EXPECT_THAT(ns.stroke.time, ElementsAre(0.0, 1e-9, 1.0));
  EXPECT_EQ(ns.clock, 1700000000123456789);
  EXPECT_THAT(ns.description, HasSubstr("time t (ns)"));
  // Other clocks since 1970 are known by their digits, too.
  EXPECT_THAT(timed({"1700000000123456", "1700000000123556"}).stroke.time, ElementsAre(0.0, 1e-4));
  EXPECT_THAT(timed({"1700000000123", "1700000000223"}).stroke.time, ElementsAre(0.0, 0.1));
  const ImportedStroke s = timed({"1700000000.25", "1700000001.5"});
  EXPECT_THAT(s.stroke.time, ElementsAre(0.25, 1.5));
  EXPECT_EQ(s.clock, 1700000000'000000000);
  // A unit that is named wins.
  EXPECT_THAT(timed({"1700000000", "1700000500"}, "t [us]").stroke.time, ElementsAre(0.0, 5e-4));
}

TEST(TableTimes, ClocksThatBeganWithTheComputerAreAskedFor) {
  std::string said;
  try {  // ns, 80 minutes after the start, at 1 kHz: as ms each sample would last a quarter of an hour
    timed({"4800000000000", "4800001000000", "4800002000000"});
  } catch (const Error& failure) {
    said = failure.what();
  }
  EXPECT_THAT(said, HasSubstr("the unit of the times 't' is not known"));
}

TEST(TableTimes, ShortStampsStayAsTheyAre) {
  const ImportedStroke plain = timed({"0.5", "0.75"}, "t_s");
  EXPECT_THAT(plain.stroke.time, ElementsAre(0.5, 0.75));
  EXPECT_FALSE(plain.clock);
}

TEST(TableTimes, DatesAreTakenRelativeToTheFirst) {
  const ImportedStroke iso =
      timed({"2024-02-28T23:59:59.999999999Z", "2024-02-29T00:00:00.5Z", "2024-03-01T00:00:00Z"});
  EXPECT_THAT(iso.stroke.time, ElementsAre(0.0, 0.500000001, 86400.000000001));
  EXPECT_THAT(iso.description, HasSubstr("time t (ISO 8601)"));
  EXPECT_EQ(iso.clock, 1709164799'999999999);
  EXPECT_THAT(timed({"2024-02-28 23:00:00+01:00", "2024-02-28 22:00:00.25+00:00"}).stroke.time,
              ElementsAre(0.0, 0.25));
  EXPECT_THAT(timed({"2024-02-28 23:00:00", "2024-02-28 23:00:01"}, "t_ms").stroke.time,
              ElementsAre(0.0, 1.0));
  EXPECT_THAT(timed({"12:00:00,5", "12:01:00,25"}).stroke.time, ElementsAre(0.0, 59.75));
}

TEST(TableTimes, IsoTimesAreReadWhole) {
  EXPECT_EQ(iso_time("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(iso_time("1970-01-01T01:00:00+01:00"), 0);
  EXPECT_EQ(iso_time("1970-01-01T01:00:00+0100"), 0);
  EXPECT_EQ(iso_time("1969-12-31T22:30:00-01:30"), 0);
  EXPECT_EQ(iso_time("1970-01-01 02:00:00,25+02"), 250'000'000);
  EXPECT_EQ(iso_time("00:00:01"), 1'000'000'000);
  EXPECT_EQ(iso_time("25:00:01"), 90'001'000'000'000);  // a clock that counts on after midnight
  for (const char* bad : {"",
                          "12",
                          "1970-01-01",
                          "1970-13-01T00:00:00",
                          "1970-01-01T00:00:00 1",
                          "1970-01-01T25:00:00",
                          "9999-01-01T00:00:00",
                          "1970-01-01T00:00:00+",
                          ":::::::",
                          "12:00:00:00",
                          "2024-05-01T12pOsit:00:00.5Z",
                          "2024-05-01T12:00:",
                          "2024-05-01T12:00:x0",
                          "12:00:",
                          "12:0a:00",
                          "12:00:01700000000123456789",
                          "12:00:001",
                          "12:00:00+01:00",
                          "12:60:00",
                          "12:00:60",
                          "12:00:99.5"})
    EXPECT_FALSE(iso_time(bad)) << bad;
  for (const char* bad_end : {".4-0\3451T1", "+0a:00", "+2", "-01:00:00", ".5.5", ".5 +02:00"})
    EXPECT_FALSE(iso_time("2024-05-01T12:00:00" + std::string(bad_end))) << bad_end;
}

TEST(TableTimes, AStampOfAnotherKindIsRefused) {
  EXPECT_THAT(refusal_of({"2024-02-28T23:59:59", "12"}),
              HasSubstr("in.csv:3: column 't_ms': '12' is not a time"));
  EXPECT_THAT(refusal_of({"1700000000123456789", "x"}), HasSubstr("'x'"));
  EXPECT_THAT(refusal_of({"17000000001234567890", "17000000001234567890"}), HasSubstr("is the same as in"));
  EXPECT_THAT(refusal_of({"9223372036854775807", "-9223372036854775807"}), HasSubstr("in.csv:3"));
}

TEST(TableTimes, ASpeedStandsForTheTimes) {
  TableSettings settings;
  settings.speed = 0.5;
  settings.position_unit = "m";
  const Stroke stroke = import_stroke_text("x,y\n0,0\n3,4\n3,4\n3,5\n", "in.csv", settings).stroke;
  EXPECT_THAT(stroke.time, ElementsAre(0.0, 10.0, 12.0));  // the tip does not wait
  EXPECT_TRUE(stroke.joined(0));                           // however far apart they are
}

TEST(TableTimes, AreGivenOnce) {
  TableSettings settings;
  settings.rate = 10.0;
  EXPECT_THAT(timed({"0", "7"}, "t_s", settings).stroke.time, ElementsAre(0.0, 0.1));  // asked for: wins
  settings.time = "t_s";
  EXPECT_THROW(timed({"0", "7"}, "t_s", settings), Error);
}

/// 2.5 s at 20 Hz, with clocks that the rate replaces.
TEST(TableTimes, AClockIsComparedWithARateAsFinelyAsItTells) {
  std::string ros = "sec,nanosec,x_m,y_m\n", whole = "t,x_m,y_m\n", broken = ros;
  for (int i = 0; i < 50; ++i) {
    const int ms = 990 + 50 * i;
    const std::string xy = "," + std::to_string(i) + ",0\n";
    ros += std::to_string(1700000000 + ms / 1000) + "," + std::to_string(ms % 1000 * 1000000) + xy;
    broken += std::to_string(1700000000 + ms / 1000) + "," +
              (i == 7 ? "x" : std::to_string(ms % 1000 * 1000000)) + xy;
    whole += "2024-05-01T12:00:0" + std::to_string(ms / 1000) + "Z" + xy;
  }
  TableSettings settings;
  settings.rate = 20.0;
  for (const std::string& text : {ros, broken, whole})
    EXPECT_THAT(import_stroke_text(text, "in.csv", settings).warnings, ElementsAre()) << text.substr(0, 80);
  settings.rate = 200.0;
  for (const std::string& text : {ros, whole})
    EXPECT_THAT(import_stroke_text(text, "in.csv", settings).warnings,
                ElementsAre(HasSubstr("in.csv: the times in column")))
        << text.substr(0, 80);
  settings.rate = 18.0;
  EXPECT_THAT(import_stroke_text(ros, "in.csv", settings).warnings,
              ElementsAre(HasSubstr("column sec last 2.45 s")));
}

}  // namespace
}  // namespace sandstroke
