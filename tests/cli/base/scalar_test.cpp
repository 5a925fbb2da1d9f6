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

// The bytes of a code point, whether or not Unicode has it.
std::string Encoded(std::uint32_t point) {
  const auto byte = [](std::uint32_t value) { return static_cast<char>(value); };
  const auto tail = [&](unsigned shift) { return byte(0x80 | ((point >> shift) & 0x3F)); };
  if (point < 0x80) return {byte(point)};
  if (point < 0x800) return {byte(0xC0 | point >> 6), tail(0)};
  if (point < 0x10000) return {byte(0xE0 | point >> 12), tail(6), tail(0)};
  return {byte(0xF0 | point >> 18), tail(12), tail(6), tail(0)};
}

TEST(Scalar, Utf8HasEveryCodePointButSurrogatesUpTo10FFFF) {
  for (std::uint32_t point = 0; point < 0x200000; point += point < 0x11000 ? 1 : 37) {
    const bool exists = point <= 0x10FFFF && (point < 0xD800 || point > 0xDFFF);
    ASSERT_EQ(IsUtf8(Encoded(point)), exists) << point;
  }
}

TEST(Scalar, Utf8EndsAtCharacters) {
  const std::string text = Encoded(0x3B5) + Encoded(0x2212) + Encoded(0x1F3B1);
  for (const std::size_t whole : {0U, 2U, 5U, 9U}) EXPECT_TRUE(IsUtf8(text.substr(0, whole)));
  for (const std::size_t part : {1U, 3U, 4U, 6U, 7U, 8U})
    EXPECT_FALSE(IsUtf8(text.substr(0, part)));
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(IsUtf8(text.substr(i)), i == 0 || i == 2 || i == 5) << i;
  }
}

}  // namespace
}  // namespace contact::cli
