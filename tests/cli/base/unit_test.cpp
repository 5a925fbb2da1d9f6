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
