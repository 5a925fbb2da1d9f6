#include "cli/verbs/laws/law_study.h"

#include <gmock/gmock.h>

#include "cli/base/failure.h"
#include "wire/scenario/scenario_codec.h"

namespace contact::cli {
namespace {

std::vector<LawPoint> PointsOf(const std::vector<std::string>& laws, double restitution) {
  std::vector<LawPoint> points;
  for (const std::string& law : laws) {
    points.push_back({.law = &FindLaw(law), .requested = restitution});
  }
  return points;
}

TEST(FindLawTest, NameIsFoundInEitherSpelling) {
  for (const LawEntry& law : LawCatalogue()) {
    std::string typed(law.name);
    for (char& letter : typed) {
      letter = letter == '_' ? '-' : static_cast<char>(std::tolower(letter));
    }
    EXPECT_EQ(&FindLaw(std::string(law.name)), &law);
    EXPECT_EQ(&FindLaw(typed), &law);
  }
}

TEST(FindLawTest, UnknownNameIsAUsageErrorWithTheNearestLaw) {
  try {
    FindLaw("hunt-crosley");
    FAIL() << "there is no such law";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_STREQ(failure.what(), "there is no law 'hunt-crosley' — did you mean 'HUNT_CROSSLEY'?");
  }
}

TEST(LawPointTest, MissIsRelativeToTheRestitutionAskedFor) {
  const LawPoint point{.requested = 0.5, .delivered = 0.6};
  EXPECT_DOUBLE_EQ(point.miss(), 0.2);
}

TEST(CollisionsOfTest, EachPointIsABallAndAWallOfItsOwn) {
  const std::vector<LawPoint> points = PointsOf({"exact", "kelvin-voigt", "lee-wang"}, 0.7);
  const v1::Scenario scenario = CollisionsOf(points);
  ASSERT_EQ(scenario.bodies_size(), 3);
  ASSERT_EQ(scenario.contacts_size(), 3);
  for (int i = 0; i < 3; ++i) {
    const v1::Contact& contact = scenario.contacts(i);
    EXPECT_EQ(contact.damping(), DampingOf(points[static_cast<std::size_t>(i)].law->law));
    EXPECT_EQ(contact.between_size(), 1);
    EXPECT_EQ(contact.between(0), scenario.bodies(i).name());
    EXPECT_DOUBLE_EQ(contact.restitution(), 0.7);
    EXPECT_GT(scenario.bodies(i).velocity_m_per_s(), 0);
  }
}

TEST(CollisionsOfTest, BallsMeetTheirWallsOneAfterTheOther) {
  const v1::Scenario scenario = CollisionsOf(PointsOf({"exact", "exact", "exact"}, 0.5));
  double last = 0;
  for (int i = 0; i < scenario.contacts_size(); ++i) {
    const double arrival =
        scenario.contacts(i).wall().position_m() / scenario.bodies(i).velocity_m_per_s();
    EXPECT_GT(arrival, last + 0.1);
    last = arrival;
  }
  EXPECT_GT(scenario.end_time_s(), last);
}

TEST(CollisionsOfTest, LinearLawHasALinearSpring) {
  const v1::Scenario scenario = CollisionsOf(PointsOf({"kelvin-voigt", "lee-wang"}, 0.5));
  EXPECT_DOUBLE_EQ(scenario.contacts(0).exponent(), 1);
  EXPECT_DOUBLE_EQ(scenario.contacts(1).exponent(), 1.5);
}

TEST(CollisionsOfTest, ScenarioObeysEveryRuleOfTheContract) {
  std::vector<LawPoint> points;
  for (const LawEntry& law : LawCatalogue()) {
    points.push_back({.law = &law, .requested = 0.9});
  }
  EXPECT_TRUE(DecodeScenario(CollisionsOf(points)).violations.empty());
}

TEST(SimulateTest, LawsInClosedFormNeedNoServer) {
  std::vector<LawPoint> points = PointsOf({"exact"}, 0.5);
  points.front().delivered = 0.5;
  Settings settings;
  settings.server = "127.0.0.1:1";
  EXPECT_NO_THROW(Simulate(&points, settings));
  EXPECT_DOUBLE_EQ(points.front().delivered, 0.5);
}

}  // namespace
}  // namespace contact::cli
