#include "cli/base/number.h"

#include <gmock/gmock.h>

#include <cmath>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;

TEST(Number, NanIsADash) {
  EXPECT_EQ(Digits(std::nan(""), 7), "-");
  EXPECT_EQ(RelativeError(std::nan("")), "-");
  EXPECT_EQ(Digits(2.259378079e8, 7), "2.259378e+08");
  EXPECT_EQ(RelativeError(1.234e-10), "1.2e-10");
}

TEST(Number, TimesHaveTheUnitThatSuitsThem) {
  EXPECT_EQ(Seconds(0), "0 s");
  EXPECT_EQ(Seconds(63e-6), "63 µs");
  EXPECT_EQ(Seconds(4e-3), "4 ms");
  EXPECT_EQ(Seconds(12.5), "12.5 s");
}

TEST(Number, InstantsAreInUtc) {
  google::protobuf::Timestamp time;
  EXPECT_EQ(Instant(time), "-");
  time.set_seconds(1'000'000'000);
  EXPECT_EQ(Instant(time), "2001-09-09 01:46:40");
}

TEST(Number, DurationsAreThoseOfTheServersFlags) {
  EXPECT_EQ(RequireDuration("10"), 10s);
  EXPECT_EQ(RequireDuration("500ms"), 500ms);
  EXPECT_EQ(RequireDuration("1.5m"), 90s);
  EXPECT_EQ(RequireDuration("30d"), 30 * 24h);
}

TEST(Number, WhatIsNoDurationIsAUsageError) {
  for (const char* text : {"", "s", "-1", "0", "0s", "1w", "ten", "inf", "nan", "1e300"}) {
    try {
      RequireDuration(text);
      ADD_FAILURE() << text;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::kUsage) << text;
    }
  }
}

TEST(Number, SecondsNeedAtMostFourDigits) {
  EXPECT_EQ(Seconds(-63e-6), "-63 µs");
  EXPECT_EQ(Seconds(1.23456e-7), "0.123 µs");
  EXPECT_EQ(Seconds(0.0123456), "12.3 ms");
  EXPECT_EQ(Seconds(123.456), "123.5 s");
}

TEST(Number, DigitsAreSignificantOnes) {
  EXPECT_EQ(Digits(0.00012345678, 3), "0.000123");
  EXPECT_EQ(Digits(1.0 / 3, 9), "0.333333333");
  EXPECT_EQ(Digits(-0.5, 9), "-0.5");
  EXPECT_EQ(Digits(1e300, 2), "1e+300");
}

}  // namespace
}  // namespace contact::cli
