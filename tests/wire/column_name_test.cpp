#include "wire/column_name.h"

#include <gmock/gmock.h>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "contact/v1/scenario.pb.h"

namespace contact {
namespace {

std::string HeaderOf(const google::protobuf::Descriptor& message, const std::string& field) {
  const ColumnName column = ColumnOf(*message.FindFieldByName(field));
  return ColumnHeader(column.name, column.unit);
}

TEST(ColumnName, UnitOfAFieldStandsInBrackets) {
  const auto& cycle = *v1::Cycle::descriptor();
  EXPECT_EQ(HeaderOf(cycle, "approach_velocity_m_per_s"), "approach_velocity [m/s]");
  EXPECT_EQ(HeaderOf(cycle, "mu_over_k_s_per_m"), "mu_over_k [s/m]");
  EXPECT_EQ(HeaderOf(cycle, "delta_max_m"), "delta_max [m]");
  EXPECT_EQ(HeaderOf(cycle, "turn_time_s"), "turn_time [s]");
  EXPECT_EQ(HeaderOf(cycle, "work_restitution_j"), "work_restitution [J]");
  EXPECT_EQ(HeaderOf(cycle, "peak_force_n"), "peak_force [N]");
}

// A sweep varies them.
TEST(ColumnName, FieldsOfAScenarioHaveUnitsToo) {
  EXPECT_EQ(HeaderOf(*v1::Body::descriptor(), "mass_kg"), "mass [kg]");
  EXPECT_EQ(HeaderOf(*v1::Body::descriptor(), "density_kg_per_m3"), "density [kg/m^3]");
  EXPECT_EQ(HeaderOf(*v1::Support::descriptor(), "damping_n_s_per_m"), "damping [N·s/m]");
  EXPECT_EQ(HeaderOf(*v1::Support::descriptor(), "stiffness_n_per_m"), "stiffness [N/m]");
  EXPECT_EQ(HeaderOf(*v1::Load::Sine::descriptor(), "angular_frequency_rad_per_s"),
            "angular_frequency [rad/s]");
  EXPECT_EQ(HeaderOf(*v1::Load::Sine::descriptor(), "phase_rad"), "phase [rad]");
  EXPECT_EQ(HeaderOf(*v1::Load::Gravity::descriptor(), "acceleration_m_per_s2"),
            "acceleration [m/s^2]");
  EXPECT_EQ(HeaderOf(*v1::Contact::descriptor(), "stiffness"), "stiffness [N/m^exponent]");
}

TEST(ColumnName, NumbersWithoutDimensionHaveUnitOneAndWordsNone) {
  const auto& cycle = *v1::Cycle::descriptor();
  EXPECT_EQ(HeaderOf(cycle, "restitution_in"), "restitution_in [1]");
  EXPECT_EQ(HeaderOf(cycle, "iterations"), "iterations [1]");
  EXPECT_EQ(HeaderOf(cycle, "contact"), "contact");
  EXPECT_EQ(HeaderOf(cycle, "status"), "status");
}

TEST(ColumnName, MuAndItsBracketHaveTheSameUnit) {
  const auto& unknown = *v1::Iteration::Unknown::descriptor();
  EXPECT_EQ(HeaderOf(*v1::Cycle::descriptor(), "mu"), "mu [N·s/m^(n+1)]");
  for (const char* field : {"mu", "bracket_low", "bracket_high"}) {
    EXPECT_EQ(ColumnOf(*unknown.FindFieldByName(field)).unit, "N·s/m^(n+1)") << field;
  }
}

}  // namespace
}  // namespace contact
