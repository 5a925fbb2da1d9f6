#include "base/duration.h"

#include <gmock/gmock.h>

#include <string>

namespace contact {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Optional;

TEST(DurationTest, EveryUnitCountsItsMilliseconds) {
  EXPECT_THAT(ParseDuration("250ms"), Optional(250ms));
  EXPECT_THAT(ParseDuration("10s"), Optional(10s));
  EXPECT_THAT(ParseDuration("5m"), Optional(5min));
  EXPECT_THAT(ParseDuration("12h"), Optional(12h));
  EXPECT_THAT(ParseDuration("30d"), Optional(720h));
}

TEST(DurationTest, NumberAloneIsInSeconds) {
  EXPECT_THAT(ParseDuration("10"), Optional(10s));
  EXPECT_THAT(ParseDuration("0.25"), Optional(250ms));
  EXPECT_THAT(ParseDuration("1e3"), Optional(1000s));
}

TEST(DurationTest, FractionsAndSpacesBeforeTheUnitAreAccepted) {
  EXPECT_THAT(ParseDuration("1.5m"), Optional(90s));
  EXPECT_THAT(ParseDuration("2 h"), Optional(2h));
}

TEST(DurationTest, OnlyZeroIsZero) {
  EXPECT_THAT(ParseDuration("0"), Optional(0ms));
  EXPECT_THAT(ParseDuration("0d"), Optional(0ms));
  EXPECT_THAT(ParseDuration("1e-9s"), Optional(1ms));
}

TEST(DurationTest, LongestIsAHundredYears) {
  EXPECT_THAT(ParseDuration("36500d"), Optional(kLongestDuration));
  EXPECT_EQ(ParseDuration("36500.1d"), std::nullopt);
  EXPECT_EQ(ParseDuration("1e308d"), std::nullopt);
}

TEST(DurationTest, OtherFormsAreRefused) {
  for (const char* text : {"", " ", "s", "ms", "-1s", "-0", "+1s", "nan", "inf", "infs", "10S",
                           "5min", "1h30m", "10s ", " 10s", "1,5s", "0x10", "10w"}) {
    EXPECT_EQ(ParseDuration(text), std::nullopt) << text;
  }
}

TEST(DurationTest, MessageQuotesTheTextAndNamesEveryUnit) {
  const std::string message = NotADuration("5min\n");
  EXPECT_THAT(message, HasSubstr("'5min?'"));
  for (const char* example : {"250ms", "10s", "5m", "12h", "30d"}) {
    EXPECT_THAT(message, HasSubstr(example));
    EXPECT_TRUE(ParseDuration(example)) << example;
  }
}

}  // namespace
}  // namespace contact
