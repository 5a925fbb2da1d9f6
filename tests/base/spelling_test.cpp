#include "base/spelling.h"

#include <gmock/gmock.h>

namespace contact {
namespace {

TEST(Spelling, NearestFindsMisspellings) {
  const std::vector<std::string_view> fields = {"restitution", "stiffness", "mass_kg", "name"};
  EXPECT_EQ(Nearest("restituton", fields), "restitution");
  EXPECT_EQ(Nearest("stifness", fields), "stiffness");
  EXPECT_EQ(Nearest("nmae", fields), "name");
}

TEST(Spelling, SwappedNeighboursAreOneMistake) {
  EXPECT_EQ(Nearest("rnu", {"list", "run"}), "run");
  EXPECT_EQ(Nearest("inti", {"init", "into"}), "init");
}

TEST(Spelling, BeginningOfAFieldIsNear) {
  EXPECT_EQ(Nearest("velocity", {"position_m", "velocity_m_per_s"}), "velocity_m_per_s");
  EXPECT_EQ(Nearest("ve", {"position_m", "velocity_m_per_s"}), "");
}

TEST(Spelling, WhatPartsWordsIsNoDifference) {
  EXPECT_EQ(Nearest("threeball", {"two-balls", "three-ball-chain"}), "three-ball-chain");
  EXPECT_EQ(Nearest("peakForce", {"peak_stress"}), "");
  EXPECT_EQ(Nearest("peak-force", {"delta_max_m", "peak_force_n"}), "peak_force_n");
  EXPECT_EQ(Nearest("---", {"--server"}), "");
}

TEST(Spelling, NothingIsNearWhatIsFar) {
  EXPECT_EQ(Nearest("colour", {"restitution", "stiffness", "mass_kg"}), "");
  EXPECT_EQ(Nearest("X", {"B1", "B2"}), "");
  EXPECT_EQ(Nearest("", {"B1"}), "");
  EXPECT_EQ(Nearest("B1", {}), "");
}

TEST(Spelling, TheFirstOfEquallyNearOnesWins) { EXPECT_EQ(Nearest("B3", {"B1", "B2"}), "B1"); }

TEST(Spelling, VeryLongNamesHaveNoNeighbours) {
  EXPECT_EQ(Nearest(std::string(1'000'000, 'a'), {std::string(64, 'a')}), "");
}

TEST(Spelling, HintNamesTheNearestOneElseWhatIsSaidOtherwise) {
  EXPECT_EQ(DidYouMean("sever", {"server", "output"}), "did you mean 'server'?");
  EXPECT_EQ(DidYouMean("sever", {"server"}, "see --help"), "did you mean 'server'?");
  EXPECT_EQ(DidYouMean("colour", {"server"}, "see --help"), "see --help");
  EXPECT_EQ(DidYouMean("colour", {"server"}), "");
}

TEST(Spelling, HintFollowsTheMessageAfterADash) {
  EXPECT_EQ(WithHint("unknown key", "see --help"), "unknown key — see --help");
  EXPECT_EQ(WithHint("unknown key", ""), "unknown key");
}

TEST(Spelling, QuotedTextHasNoControlCharactersAndALimit) {
  EXPECT_EQ(Quoted("ball"), "'ball'");
  EXPECT_EQ(Quoted("a\x1b[31m\n"), "'a?[31m?'");
  EXPECT_EQ(Quoted(std::string(64, 'x')), "'" + std::string(64, 'x') + "'");
  EXPECT_EQ(Quoted(std::string(65, 'x')), "'" + std::string(64, 'x') + "…'");
}

// A character of Unicode in UTF-8.
std::string Utf8(unsigned code) {
  const auto part = [code](unsigned shift) {
    return static_cast<char>(0x80U | (code >> shift & 0x3FU));
  };
  if (code < 0x80) return {static_cast<char>(code)};
  if (code < 0x800) return {static_cast<char>(0xC0U | code >> 6U), part(0)};
  return {static_cast<char>(0xE0U | code >> 12U), part(6), part(0)};
}

TEST(Spelling, NoPrintableTextSteersATerminalOrTurnsItsDirection) {
  for (unsigned code = 0; code < 0x3000; ++code) {
    const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool line = code == 0x2028 || code == 0x2029;
    const bool direction = code == 0x61C || code == 0x200E || code == 0x200F ||
                           (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
    const std::string text = "μ" + Utf8(code) + "…";
    const bool kept = !(control || line || direction);
    EXPECT_EQ(Printable(text), kept ? text : "μ?…") << code;
  }
  EXPECT_EQ(Printable("a\x1b]0;b\x07", ' '), "a ]0;b ");
  EXPECT_EQ(Printable("cut \xE2\x80"), "cut \xE2\x80");
}

TEST(Spelling, PrintableLinesStayLines) {
  EXPECT_EQ(PrintableLines("a\tb\n\x1b[31mc\r\n"), "a\tb\n?[31mc?\n");
}

TEST(Spelling, QuotedTextIsNeverCutInsideACharacter) {
  std::string text = "x";
  for (int i = 0; i < 40; ++i) text += "δ";
  const std::string quoted = Quoted(text);
  EXPECT_EQ(quoted.substr(quoted.size() - 6), "δ…'") << quoted;
}

TEST(Count, KnowsItsPlural) {
  EXPECT_EQ(Count(1, "body", "bodies"), "1 body");
  EXPECT_EQ(Count(0, "body", "bodies"), "0 bodies");
}

}  // namespace
}  // namespace contact
