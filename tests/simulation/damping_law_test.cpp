#include "simulation/laws/damping_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace contact {
namespace {

TEST(ExactCoefficient, SolvesItsEquation) {
  for (double e = 0.05; e < 0.999; e += 0.01) {
    const double a = ExactCoefficient(e);
    EXPECT_NEAR(a * (1 + e), std::log((1 + a) / (1 - a * e)), 2e-8 * a * (1 + e)) << e;
  }
}

TEST(ExactCoefficient, EqualsTheTabulatedValues) {
  EXPECT_NEAR(ExactCoefficient(0.5), 1.43275053327, 1e-11);
  EXPECT_NEAR(ExactCoefficient(0.8), 0.373146203365, 1e-12);
  EXPECT_EQ(ExactCoefficient(1), 0);
}

// Backwards in time a collision with ε has α' = −αε and ε' = 1/ε.
TEST(ExactCoefficient, IsItsOwnTimeReversal) {
  for (const double e : {0.2, 0.5, 0.9, 0.999}) {
    EXPECT_NEAR(ExactCoefficient(1 / e), -ExactCoefficient(e) * e, 1e-14);
  }
}

TEST(DeliveredRestitution, InvertsExactCoefficientToRoundOff) {
  for (double e = 0.001; e < 1; e += 0.001) {
    EXPECT_NEAR(DeliveredRestitution(ExactCoefficient(e)) / e, 1, 1e-14) << e;
  }
  for (const double e : {1e-3, 1 - 1e-6, 1 - 1e-10}) {
    EXPECT_NEAR(DeliveredRestitution(ExactCoefficient(e)) / e, 1, 1e-14) << e;
  }
}

struct Row {
  DampingLaw law;
  double delivered[4];  // For requested ε = 0.3, 0.5, 0.7, 0.9.
};

// Computed independently, from the closed form of an isolated collision.
constexpr Row kDelivered[] = {
    {DampingLaw::kExact, {.3, .5, .7, .9}},
    {DampingLaw::kPaperEq23, {.29927, .50403, .70320, .90055}},
    {DampingLaw::kHuntCrossley, {.58129, .66296, .76800, .90902}},
    {DampingLaw::kLankaraniNikravesh, {.68422, .72524, .79597, .91318}},
    {DampingLaw::kFlores, {.25621, .47044, .68318, .89392}},
    {DampingLaw::kHuGuo, {.27066, .48774, .69730, .89990}},
    {DampingLaw::kLeeWang, {.73900, .79920, .86934, .95237}},
    {DampingLaw::kHerbertMcWhannell, {.51997, .59362, .72268, .90089}},
    {DampingLaw::kZhiyingQishao, {.32670, .48261, .67957, .89592}},
    {DampingLaw::kGonthier, {.30422, .48774, .66958, .87644}},
    {DampingLaw::kCarvalhoMartins, {.30397, .50017, .69997, .90000}},
    {DampingLaw::kGharibHurmuzlu, {.28188, .41072, .50078, .56681}},
};

TEST(DampingCoefficient, DeliversWhatIsKnownOfEachLaw) {
  const double requested[] = {0.3, 0.5, 0.7, 0.9};
  for (const Row& row : kDelivered) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(DeliveredRestitution(DampingCoefficient(row.law, requested[i])), row.delivered[i],
                  6e-6)
          << "law " << static_cast<int>(row.law) << ", requested " << requested[i];
    }
  }
}

// The lines of a file of the tree that begin with `start`.
std::vector<std::string> LinesOf(const std::string& path, const std::string& start) {
  std::ifstream file(std::string(CONTACT_SOURCE_DIR) + "/" + path);
  EXPECT_TRUE(file.is_open()) << path;
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(start)) lines.push_back(line);
  }
  return lines;
}

TEST(DampingLaws, ReadmeHasTheTableOfTheCode) {
  std::vector<std::string> rows;
  for (const DampingLawRow& law : DampingLaws()) {
    rows.push_back("| `" + std::string(law.name) + "` | " + std::string(law.formula) + " | " +
                   std::string(law.source) + " | " + std::string(law.range) + " |");
  }
  EXPECT_EQ(LinesOf("server/simulation/README.md", "| `"), rows);
}

TEST(DampingLaws, ReferenceOfScenariosHasEachLawWithItsFormula) {
  for (const DampingLawRow& law : DampingLaws()) {
    const auto lines =
        LinesOf("client/scenarios/README.md", "  - `" + std::string(law.name) + "`: ");
    ASSERT_EQ(lines.size(), 1u) << law.name;
    if (lines[0].find("α = ") == std::string::npos) continue;
    EXPECT_NE(lines[0].find(law.formula), std::string::npos) << lines[0];
  }
}

TEST(DampingLaws, DampMoreTheLessIsToComeBack) {
  for (const DampingLawRow& law : DampingLaws()) {
    if (law.scale == DampingScale::kNone) continue;
    // α = 1/ε is made for ε near 0 alone.
    if (law.law != DampingLaw::kGharibHurmuzlu) {
      EXPECT_EQ(law.alpha(1), 0) << law.name;
    }
    for (double e = 0.05; e < 1; e += 0.05) {
      EXPECT_GT(law.alpha(e), law.alpha(e + 1e-3)) << law.name << " " << e;
    }
  }
}

// Half a period of k δ + c δ̇ leaves e^{−ξπ/√(1−ξ²)} of the speed, with c = 2 ξ √(k m_e).
TEST(DampingLaws, KelvinVoigtLeavesItsRestitutionAfterHalfAPeriod) {
  for (const double e : {0.05, 0.5, 0.95}) {
    const double ratio = RowOf(DampingLaw::kKelvinVoigt).alpha(e) / 2;
    EXPECT_NEAR(std::exp(-ratio * std::numbers::pi / std::sqrt(1 - ratio * ratio)), e, 1e-14);
  }
}

TEST(ElasticEnergy, IsTheWorkOfTheElasticForce) {
  constexpr int kIntervals = 20000;
  for (const double n : {1.0, 1.5, 2.2}) {
    const double k = 3e7, deformation = 2e-4, h = deformation / kIntervals;
    double work = 0;  // By the midpoint rule.
    for (int i = 0; i < kIntervals; ++i) work += k * std::pow((i + 0.5) * h, n) * h;
    EXPECT_NEAR(ElasticEnergy(k, n, deformation) / work, 1, 1e-6) << n;
    EXPECT_EQ(ElasticEnergy(k, n, -deformation), 0);
  }
}

TEST(MaximumDeformation, OfAnElasticCollisionHoldsItsKineticEnergy) {
  for (const double n : {1.0, 1.5, 2.2}) {
    const double deformation = MaximumDeformation(0.5, 2, 1e8, n, 0);
    EXPECT_NEAR(ElasticEnergy(1e8, n, deformation), 0.5 * 0.5 * 2 * 2, 1e-14) << n;
  }
}

TEST(MaximumDeformation, OfAnElasticHertzCollisionIsTheClassicalOne) {
  const double m = 0.5, v = 2, k = 1e8;
  EXPECT_NEAR(MaximumDeformation(m, v, k, 1.5, 0), std::pow(5 * m * v * v / (4 * k), 0.4), 1e-15);
  EXPECT_NEAR(MaximumDeformation(m, v, k, 1.5, 1e-9), MaximumDeformation(m, v, k, 1.5, 0), 1e-12);
}

}  // namespace
}  // namespace contact
