#include "cli/base/number.h"

#include <gmock/gmock.h>

#include <cmath>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

TEST(Number, NanIsADash) {
  EXPECT_EQ(Digits(std::nan(""), 7), "-");
  EXPECT_EQ(Error(std::nan("")), "-");
  EXPECT_EQ(Digits(2.259378079e8, 7), "2.259378e+08");
  EXPECT_EQ(Error(1.234e-10), "1.2e-10");
}

TEST(Number, TimesHaveTheUnitThatSuitsThem) {
  EXPECT_EQ(Seconds(0), "0 s");
  EXPECT_EQ(Seconds(63e-6), "63 µs");
  EXPECT_EQ(Seconds(4e-3), "4 ms");
  EXPECT_EQ(Seconds(12.5), "12.5 s");
}

TEST(Number, CountsKnowTheirPlural) {
  EXPECT_EQ(Count(1, "body", "bodies"), "1 body");
  EXPECT_EQ(Count(0, "body", "bodies"), "0 bodies");
}

TEST(Number, InstantsAreInUtc) {
  google::protobuf::Timestamp time;
  EXPECT_EQ(Instant(time), "-");
  time.set_seconds(1'000'000'000);
  EXPECT_EQ(Instant(time), "2001-09-09 01:46:40");
}

TEST(Number, DurationsHaveAUnitOrAreSeconds) {
  EXPECT_EQ(ParseDuration("10"), 10s);
  EXPECT_EQ(ParseDuration("0.5s"), 500ms);
  EXPECT_EQ(ParseDuration("500ms"), 500ms);
  EXPECT_EQ(ParseDuration("2m"), 2min);
  EXPECT_EQ(ParseDuration("1h"), 1h);
  for (const char* text : {"", "s", "-1", "0", "1d", "ten", "inf", "nan", "1e300"}) {
    EXPECT_THROW(ParseDuration(text), Failure) << text;
  }
}

}  // namespace
}  // namespace contact::cli
