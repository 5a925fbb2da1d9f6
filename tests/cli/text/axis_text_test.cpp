#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cli/text/sweep/sweep_cells.h"

namespace contact::cli {
namespace {

v1::Sweep::Axis Axis(const std::string& field) {
  v1::Sweep::Axis axis;
  axis.set_field(field);
  return axis;
}

TEST(AxisText, WithoutDigitsGivesTheSameDoubleBack) {
  for (const double value : {0.1, 1.0 / 3, 6.02214076e23, -2.5e-300}) {
    EXPECT_EQ(std::stod(AxisText(Axis("bodies[0].mass_kg"), value)), value);
  }
}

TEST(AxisText, DigitsAreSignificantOnes) {
  EXPECT_EQ(AxisText(Axis("bodies[0].mass_kg"), 1.0 / 3, 4), "0.3333");
  EXPECT_EQ(AxisText(Axis("bodies[0].mass_kg"), 2.0, 4), "2");
}

TEST(AxisText, ValueOfAnEnumIsItsWordHoweverTheEntryIsNamed) {
  for (const char* field :
       {"contacts[0].damping", "contacts[*].damping", "contacts[A-B].damping"}) {
    EXPECT_EQ(AxisText(Axis(field), v1::Contact::FLORES, 4), "FLORES") << field;
  }
  EXPECT_EQ(AxisText(Axis("contacts[0].damping"), 1e9, 4), "1e+09") << "no such word";
}

TEST(AxisText, WordIsThatOfTheFieldWhateverTheLabel) {
  v1::Sweep::Axis axis = Axis("contacts[0].damping");
  axis.set_label("var:law");
  EXPECT_EQ(AxisText(axis, v1::Contact::EXACT), "EXACT");
}

}  // namespace
}  // namespace contact::cli
