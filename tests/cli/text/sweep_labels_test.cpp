#include "cli/text/sweep/sweep_labels.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

namespace contact::cli {
namespace {

// The label of an axis over this field of a chain with a wall.
std::string LabelOf(const std::string& field) {
  v1::Sweep sweep;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(R"(
      bodies { name: "B1" } bodies { name: "B2" }
      contacts { between: "B1" between: "B2" }
      contacts { name: "end" between: "B2" wall { side: RIGHT } }
      loads { body: "B2" constant { force_n: 1 } })",
                                                            sweep.mutable_base()));
  sweep.add_axes()->set_field(field);
  return AxisLabel(sweep, 0);
}

TEST(AxisLabel, NamesTheQuantityItsOwnerAndItsUnit) {
  EXPECT_EQ(LabelOf("bodies[0].velocity_m_per_s"), "velocity of B1 [m/s]");
  EXPECT_EQ(LabelOf("bodies[1].mass_kg"), "mass of B2 [kg]");
  EXPECT_EQ(LabelOf("contacts[0].restitution"), "restitution of B1-B2 [1]");
  EXPECT_EQ(LabelOf("contacts[1].wall.position_m"), "wall position of end [m]");
  EXPECT_EQ(LabelOf("contacts[*].stiffness"), "stiffness of all contacts [N/m^exponent]");
  EXPECT_EQ(LabelOf("loads[0].constant.force_n"), "constant force of loads[0] on B2 [N]");
  EXPECT_EQ(LabelOf("end_time_s"), "end time [s]");
  EXPECT_EQ(LabelOf("solver.step_s"), "solver step [s]");
}

TEST(AxisLabel, CountsAndWordsHaveNoUnit) {
  EXPECT_EQ(LabelOf("solver.max_iterations"), "solver max iterations");
  EXPECT_EQ(LabelOf("contacts[0].damping"), "damping of B1-B2");
}

TEST(AxisLabel, UnknownPathsAndEntriesStayAsTheyAre) {
  EXPECT_EQ(LabelOf("bodies[0].colour"), "bodies[0].colour");
  EXPECT_EQ(LabelOf("bodies["), "bodies[");
  EXPECT_EQ(LabelOf("bodies[7].mass_kg"), "mass of bodies[7] [kg]");
}

TEST(MetricLabel, NamesTheQuantityItsOwnerAndItsUnit) {
  EXPECT_EQ(MetricLabel("final_bodies[B3].velocity_m_per_s"), "final velocity of B3 [m/s]");
  EXPECT_EQ(MetricLabel("cycles[B1-B2].alpha"), "alpha of B1-B2 [1]");
  EXPECT_EQ(MetricLabel("cycles[B1-B2].mu_over_k_s_per_m"), "mu over k of B1-B2 [s/m]");
  EXPECT_EQ(MetricLabel("cycles[2].peak_force_n"), "peak force of cycles[2] [N]");
  EXPECT_EQ(MetricLabel("cycles[B1-B2].restitution_out"), "restitution out, B1-B2 [1]");
  EXPECT_EQ(MetricLabel("groups[B1-B2].mu"), "group mu of B1-B2 [N·s/m^(n+1)]");
}

TEST(MetricLabel, FieldsOfTheSummaryMayStandAlone) {
  EXPECT_EQ(MetricLabel("iterations"), "iterations");
  EXPECT_EQ(MetricLabel("summary.energy_residual"), "energy residual [1]");
  EXPECT_EQ(MetricLabel("convergence"), "convergence");
  EXPECT_EQ(MetricLabel("nonsense"), "nonsense");
  EXPECT_EQ(MetricLabel("summary"), "summary");
}

}  // namespace
}  // namespace contact::cli
