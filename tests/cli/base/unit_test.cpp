#include "cli/base/unit.h"

#include <gtest/gtest.h>

namespace contact::cli {
namespace {

TEST(UnitFactor, IsOneForTheUnitItself) {
  for (const char* unit : {"s", "m", "m/s", "N"}) EXPECT_EQ(UnitFactor(unit, unit), 1) << unit;
  EXPECT_EQ(UnitFactor("1", "1"), 1);
}

TEST(UnitFactor, ReadsPrefixesAndQuotients) {
  EXPECT_EQ(UnitFactor("mm", "m"), 1e-3);
  EXPECT_EQ(UnitFactor("µm", "m"), 1e-6);
  EXPECT_EQ(UnitFactor("um", "m"), 1e-6);
  EXPECT_EQ(UnitFactor("kN", "N"), 1e3);
  EXPECT_EQ(UnitFactor("ms", "s"), 1e-3);
  EXPECT_EQ(UnitFactor("min", "s"), 60);
  EXPECT_EQ(UnitFactor("mm/s", "m/s"), 1e-3);
  EXPECT_EQ(UnitFactor("mm/ms", "m/s"), 1);
  EXPECT_DOUBLE_EQ(*UnitFactor("km/h", "m/s"), 1 / 3.6);
}

TEST(UnitFactor, KnowsUnitsOfOtherSystemsExactly) {
  for (const auto& [unit, si, factor] : {std::tuple{"g", "m/s^2", 9.80665},
                                         {"gn", "m/s²", 9.80665},
                                         {"mg", "m/s^2", 9.80665e-3},
                                         {"mm/s²", "m/s^2", 1e-3},
                                         {"m/s2", "m/s^2", 1},
                                         {"m/ms^2", "m/s^2", 1e6},
                                         {"ft/s^2", "m/s^2", 0.3048},
                                         {"mph", "m/s", 0.44704},
                                         {"ft/s", "m/s", 0.3048},
                                         {"in", "m", 0.0254},
                                         {"ft", "m", 0.3048},
                                         {"kgf", "N", 9.80665},
                                         {"lbf", "N", 4.4482216152605},
                                         {"MN", "N", 1e6},
                                         {"mN", "N", 1e-3}}) {
    EXPECT_DOUBLE_EQ(UnitFactor(unit, si).value_or(0), factor) << unit;
    EXPECT_TRUE(IsUnit(unit)) << unit;
  }
  EXPECT_EQ(UnitFactor("g", "m/s"), std::nullopt);
  EXPECT_EQ(UnitFactor("m/s", "m/s^2"), std::nullopt);
  EXPECT_EQ(UnitFactor("m/s^2", "m/s"), std::nullopt);
  EXPECT_FALSE(IsUnit("V"));
}

TEST(UnitFactor, MessagesNameUnitsThatItKnows) {
  for (const std::string si : {"s", "m", "m/s", "m/s^2", "N"}) {
    std::string rest = UsualUnits(si) + ", ";
    for (std::size_t end = 0; (end = rest.find(", ")) != std::string::npos;) {
      EXPECT_TRUE(UnitFactor(rest.substr(0, end), si)) << rest;
      rest.erase(0, end + 2);
    }
  }
}

TEST(InSi, AMillimetreIsTheSameNumberAsAThousandthOfAMetre) {
  for (int i = 1; i < 1000; ++i) EXPECT_EQ(InSi(i, 1e-3), i / 1000.0);
  EXPECT_EQ(InSi(3, 9.80665), 3 * 9.80665);
}

TEST(UnitFactor, RefusesOtherKindsAndUnknownUnits) {
  for (const auto& [unit, si] : {std::pair{"m", "s"},
                                 {"m", "m/s"},
                                 {"m/s", "m"},
                                 {"inch", "m"},
                                 {"", "m"},
                                 {"mmm", "m"},
                                 {"m/s/s", "m/s"},
                                 {"h", "m"}}) {
    EXPECT_EQ(UnitFactor(unit, si), std::nullopt) << unit << " as " << si;
  }
}

}  // namespace
}  // namespace contact::cli
