#include "cli/base/scalar.h"

#include <gmock/gmock.h>

namespace contact::cli {
namespace {

using testing::Eq;
using testing::Optional;

TEST(Scalar, NumbersAreReadAsYamlAndJsonWriteThem) {
  EXPECT_THAT(ParseNumber("0.5"), Optional(0.5));
  EXPECT_THAT(ParseNumber("-1e-3"), Optional(-1e-3));
  EXPECT_THAT(ParseNumber("+1.0E8"), Optional(1e8));
  EXPECT_THAT(ParseNumber("7"), Optional(7.0));
  EXPECT_THAT(ParseNumber(".5"), Optional(0.5));
  EXPECT_THAT(ParseNumber("-.inf"), Optional(-std::numeric_limits<double>::infinity()));
  EXPECT_TRUE(std::isnan(ParseNumber(".NaN").value()));
  EXPECT_TRUE(std::isnan(ParseNumber("NaN").value()));
}

TEST(Scalar, WhatIsNotWhollyANumberIsNone) {
  for (const char* text : {"", "-", "+", "+-1", "--1", "0.5 kg", "0,5", "1e400", "0x10", "1_000",
                           " 1", "1 ", "one", "."}) {
    EXPECT_THAT(ParseNumber(text), Eq(std::nullopt)) << text;
  }
}

TEST(Scalar, WholeNumbersMayHaveAnExponentButNoFraction) {
  EXPECT_THAT(ParseInteger<std::int64_t>("100000000"), Optional(100'000'000));
  EXPECT_THAT(ParseInteger<std::int64_t>("1e8"), Optional(100'000'000));
  EXPECT_THAT(ParseInteger<std::int64_t>("9223372036854775807"),
              Optional(std::numeric_limits<std::int64_t>::max()));
  EXPECT_THAT(ParseInteger<std::int64_t>("9223372036854775808"), Eq(std::nullopt));
  EXPECT_THAT(ParseInteger<std::int32_t>("2147483648"), Eq(std::nullopt));
  EXPECT_THAT(ParseInteger<std::int32_t>("2.5"), Eq(std::nullopt));
  EXPECT_THAT(ParseInteger<std::int32_t>(".nan"), Eq(std::nullopt));
}

TEST(Scalar, OnlyTrueAndFalseAreFlags) {
  EXPECT_THAT(ParseBool("true"), Optional(true));
  EXPECT_THAT(ParseBool("False"), Optional(false));
  for (const char* text : {"yes", "on", "1", "", "tRuE"}) {
    EXPECT_THAT(ParseBool(text), Eq(std::nullopt)) << text;
  }
}

TEST(Scalar, Utf8IsWellFormedOrIsNot) {
  for (const char* text : {"", "ball", "δ̇⁻ = 0,2", "\xF0\x9F\x8E\xB1", "\xED\x9F\xBF"}) {
    EXPECT_TRUE(IsUtf8(text)) << text;
  }
  for (const char* text : {"\xDF", "Sto\xDF", "\x80", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80",
                           "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xE2\x82"}) {
    EXPECT_FALSE(IsUtf8(text)) << text;
  }
}

}  // namespace
}  // namespace contact::cli
