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
