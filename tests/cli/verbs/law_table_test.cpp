#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "cli/verbs/laws/law_study.h"
#include "cli/verbs/verb_case.h"

namespace contact::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::vector<double> kRestitutions = {0.3, 0.6, 1.0};

// The points of all laws in closed form, law by law.
std::vector<LawPoint> ClosedPoints() {
  std::vector<LawPoint> points;
  for (const LawEntry* law : ChooseLaws({}, true)) {
    for (const double e : kRestitutions) points.push_back(PointOf(*law, e));
  }
  return points;
}

TEST(ChooseLawsTest, NamedLawsComeInTheirOrderElseAllThatWillDo) {
  const auto named = ChooseLaws({"kelvin-voigt", "EXACT"}, true);
  ASSERT_EQ(named.size(), 2U);  // A law that is named needs no closed form.
  EXPECT_EQ(named[0]->name, "KELVIN_VOIGT");
  EXPECT_EQ(named[1]->name, "EXACT");
  EXPECT_EQ(ChooseLaws({}, false).size(), LawCatalogue().size());
  for (const LawEntry* law : ChooseLaws({}, true)) EXPECT_TRUE(law->closed_form()) << law->name;
}

TEST(PointOfTest, ExactLawDeliversWhatIsAskedFor) {
  const LawEntry& exact = FindLaw("exact");
  for (int i = 1; i <= 100; ++i) {
    EXPECT_NEAR(PointOf(exact, 0.01 * i).miss(), 0, 1e-9) << i;
  }
}

TEST(PointOfTest, EveryLawIsElasticForRestitutionOne) {
  for (const LawEntry* law : ChooseLaws({}, true)) {
    if (std::abs(law->alpha(1)) < 1e-12) {
      EXPECT_NEAR(PointOf(*law, 1).delivered, 1, 1e-9) << law->name;
    }
  }
}

TEST(PointOfTest, LawWithoutClosedFormIsLeftToASimulation) {
  const LawPoint point = PointOf(FindLaw("kelvin-voigt"), 0.5);
  EXPECT_EQ(point.delivered, 0);
  EXPECT_EQ(point.method(), "simulation");
  EXPECT_EQ(PointOf(FindLaw("exact"), 0.5).method(), "closed form");
}

TEST(LawJsonTest, ListHasTheObjectOfEachLaw) {
  const json list = json::parse(LawsJson(LawCatalogue()));
  ASSERT_EQ(list.size(), LawCatalogue().size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i], json::parse(LawJson(LawCatalogue()[i])));
    EXPECT_EQ(list[i]["law"], LawCatalogue()[i].name);
  }
}

TEST(PointsJsonTest, NumbersKeepAllTheirDigits) {
  const std::vector<LawPoint> points = ClosedPoints();
  const json list = json::parse(PointsJson(points));
  ASSERT_EQ(list.size(), points.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i]["delivered"].get<double>(), points[i].delivered);
    EXPECT_EQ(list[i]["miss"].get<double>(), points[i].miss());
  }
}

TEST(PointTableTest, CsvGivesEveryDoubleBack) {
  const std::vector<LawPoint> points = ClosedPoints();
  const std::vector<std::string> lines = Lines(PointTable(points).Csv({"law", "delivered"}));
  ASSERT_EQ(lines.size(), points.size() + 1);
  EXPECT_EQ(lines[0], "law,delivered");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t comma = lines[i + 1].find(',');
    EXPECT_EQ(lines[i + 1].substr(0, comma), points[i].law->name);
    EXPECT_EQ(std::strtod(lines[i + 1].c_str() + comma + 1, nullptr), points[i].delivered);
  }
}

TEST(ComparisonTableTest, EachLawIsARowWithAColumnForEachRestitution) {
  const std::vector<LawPoint> points = ClosedPoints();
  EXPECT_EQ(ComparisonColumns(kRestitutions).size(), 1 + kRestitutions.size());
  const std::vector<std::string> lines = Lines(ComparisonTable(points, kRestitutions).Text({}));
  ASSERT_EQ(lines.size(), 1 + points.size() / kRestitutions.size());
  EXPECT_THAT(lines[0], testing::ContainsRegex("^LAW +0\\.3 +0\\.6 +1$"));
  for (std::size_t row = 1; row < lines.size(); ++row) {
    const LawPoint& first = points[(row - 1) * kRestitutions.size()];
    EXPECT_THAT(lines[row], testing::StartsWith(std::string(first.law->name)));
    EXPECT_THAT(lines[row], HasSubstr(fmt::format("{:.5f}", first.delivered)));
  }
}

TEST(ComparisonTableTest, OnlyMissesOfMoreThanOnePercentStandOut) {
  const LawEntry& law = FindLaw("exact");
  const std::vector<LawPoint> points = {{.law = &law, .requested = 0.5, .delivered = 0.5049},
                                        {.law = &law, .requested = 0.6, .delivered = 0.6061}};
  const Style style{.color = true};
  const std::string text = ComparisonTable(points, {0.5, 0.6}).Text(style);
  EXPECT_THAT(text, HasSubstr(Paint("0.50490", Tone::kGood, style)));
  EXPECT_THAT(text, HasSubstr(Paint("0.60610", Tone::kWarning, style)));
}

TEST(DeliveryTableTest, MissIsInPercentWithItsSign) {
  const LawEntry& law = FindLaw("hunt-crossley");
  const std::vector<std::string> lines = Lines(DeliveryTable(law, kRestitutions).Text({}));
  ASSERT_EQ(lines.size(), 1 + kRestitutions.size());
  for (std::size_t i = 0; i < kRestitutions.size(); ++i) {
    const LawPoint point = PointOf(law, kRestitutions[i]);
    EXPECT_TRUE(lines[i + 1].ends_with(fmt::format("{:+.2f} %", 100 * point.miss()))) << i;
  }
}

}  // namespace
}  // namespace contact::cli
