#include "cli/figures/form/axis_unit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace contact::cli {
namespace {

TEST(ReadableUnit, HasThePrefixThatLeavesOneToThreeDigits) {
  EXPECT_EQ(ReadableUnit("time [s]", 0.004).label, "time [ms]");
  EXPECT_DOUBLE_EQ(ReadableUnit("time [s]", 0.004).size, 1e-3);
  EXPECT_EQ(ReadableUnit("deformation [m]", 2.3e-5).label, "deformation [µm]");
  EXPECT_DOUBLE_EQ(ReadableUnit("deformation [m]", 2.3e-5).size, 1e-6);
  EXPECT_EQ(ReadableUnit("force [N]", 10'507).label, "force [kN]");
  EXPECT_EQ(ReadableUnit("velocity [m/s]", 0.02).label, "velocity [mm/s]");
  EXPECT_EQ(ReadableUnit("μ [N·s/m^(n+1)]", 2.3e8).label, "μ [MN·s/m^(n+1)]");
}

TEST(ReadableUnit, EndsOfADecadeOfThreeBelongToOneOfThem) {
  EXPECT_EQ(ReadableUnit("force [N]", 999.9).label, "force [N]");
  EXPECT_EQ(ReadableUnit("force [N]", 1000).label, "force [kN]");
  EXPECT_EQ(ReadableUnit("deformation [m]", 1e-3).label, "deformation [mm]");
  EXPECT_EQ(ReadableUnit("deformation [m]", 1e-6).label, "deformation [µm]");
}

TEST(ReadableUnit, NumbersFromATenthToAThousandNeedNone) {
  for (const double largest : {0.1, 0.2, 1.0, 105.0, 999.0}) {
    EXPECT_EQ(ReadableUnit("velocity [m/s]", largest).label, "velocity [m/s]") << largest;
    EXPECT_EQ(ReadableUnit("velocity [m/s]", largest).size, 1) << largest;
  }
}

TEST(ReadableUnit, WhatTakesNoPrefixHasAPowerOfTen) {
  EXPECT_EQ(ReadableUnit("error [1]", 2e-6).label, "error [10^-6]");
  EXPECT_DOUBLE_EQ(ReadableUnit("error [1]", 2e-6).size, 1e-6);
  EXPECT_EQ(ReadableUnit("mass [kg]", 3e-5).label, "mass [10^-6 kg]");
  EXPECT_EQ(ReadableUnit("area [m^2]", 3e-5).label, "area [10^-6 m^2]");
  EXPECT_EQ(ReadableUnit("work [J]", 3e-20).label, "work [10^-21 J]");
  EXPECT_EQ(ReadableUnit("iterations [1]", 4000).label, "iterations [1]");
}

TEST(ReadableUnit, NobodySaysKiloseconds) {
  EXPECT_EQ(ReadableUnit("time [s]", 3600).label, "time [s]");
  EXPECT_EQ(ReadableUnit("time [s]", 2e6).label, "time [10^6 s]");
}

TEST(ReadableUnit, LabelsWithoutUnitAndAxesWithoutNumbersStayAsTheyAre) {
  EXPECT_EQ(ReadableUnit("pass", 1e6).label, "pass");
  EXPECT_EQ(ReadableUnit("pass", 1e6).size, 1);
  for (const double none :
       {0.0, static_cast<double>(NAN), std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(ReadableUnit("force [N]", none).label, "force [N]");
  }
}

TEST(NamedUnit, IsThatOfTheLabelWithAnyPrefix) {
  EXPECT_EQ(NamedUnit("force [N]", "kN")->label, "force [kN]");
  EXPECT_DOUBLE_EQ(NamedUnit("force [N]", "kN")->size, 1e3);
  EXPECT_EQ(NamedUnit("force [N]", "N")->size, 1);
  EXPECT_EQ(NamedUnit("velocity [m/s]", "mm/s")->label, "velocity [mm/s]");
  EXPECT_FALSE(NamedUnit("force [N]", "kg"));
  EXPECT_FALSE(NamedUnit("force [N]", "xN"));
  EXPECT_FALSE(NamedUnit("mass [kg]", "mkg"));
  EXPECT_FALSE(NamedUnit("pass", "ms"));
}

TEST(NamedUnit, MicroHasThreeSpellings) {
  for (const char* unit : {"um", "µm", "μm"}) {
    const auto named = NamedUnit("deformation [m]", unit);
    ASSERT_TRUE(named) << unit;
    EXPECT_EQ(named->label, "deformation [µm]");
    EXPECT_DOUBLE_EQ(named->size, 1e-6);
  }
}

TEST(UnitOf, IsWhatStandsInTheLastBrackets) {
  EXPECT_EQ(UnitOf("cycles[B1-B2] of a [m/s]"), "m/s");
  EXPECT_EQ(UnitOf("no unit"), "");
  EXPECT_EQ(UnitOf("cycles[0] of"), "");
}

}  // namespace
}  // namespace contact::cli
