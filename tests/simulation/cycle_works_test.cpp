#include "simulation/motion/cycle_works.h"

#include <gtest/gtest.h>

#include "simulation/model/contact_spring.h"

namespace contact {
namespace {

const Contact kContact{.name = "C", .stiffness = 3e7, .exponent = 1.5};

double Energy(double deformation) { return ElasticEnergy(kContact, deformation, 0); }

TEST(CycleWorks, WhatIsNotStoredIsDissipated) {
  for (const double start : {0.0, 2e-5}) {
    for (const double end : {0.0, 3e-5}) {
      ContactState state;
      Cycle& cycle = state.cycle;
      cycle.start_deformation = start, cycle.end_deformation = end, state.stored = Energy(start);
      SetCompression(kContact, 1e-4, 0.9, 0.2, &state);
      SetRestitution(kContact, 1e-4, 0.4, 0.15, &state);
      // (W2) of each phase: W = dissipated + change of the elastic energy.
      EXPECT_NEAR(cycle.work_compression,
                  cycle.dissipated_compression + Energy(1e-4) - Energy(start), 1e-15);
      EXPECT_NEAR(cycle.work_restitution, cycle.dissipated_restitution + Energy(end) - Energy(1e-4),
                  1e-15);
      // Over the whole cycle W and E are those at its end.
      EXPECT_DOUBLE_EQ(cycle.work_compression + cycle.work_restitution, 0.4);
      EXPECT_DOUBLE_EQ(cycle.external_compression + cycle.external_restitution, 0.15);
    }
  }
}

TEST(CycleWorks, AnElasticCycleDissipatesNothing) {
  ContactState state;
  const Cycle& cycle = state.cycle;
  SetCompression(kContact, 2e-4, Energy(2e-4), 0, &state);
  SetRestitution(kContact, 2e-4, 0, 0, &state);
  EXPECT_EQ(cycle.dissipated_compression, 0);
  EXPECT_EQ(cycle.dissipated_restitution, 0);
  EXPECT_EQ(cycle.work_restitution, -cycle.work_compression);
}

// Where the phases are cut changes what each has, not what the cycle has.
TEST(CycleWorks, TheSplitOfTheCycleDoesNotChangeItsLoss) {
  const auto loss = [](double split, double work) {
    ContactState state;
    Cycle& cycle = state.cycle;
    cycle.end_deformation = 1e-5;
    SetCompression(kContact, split, work, 0, &state);
    SetRestitution(kContact, split, 0.3, 0, &state);
    return cycle.dissipated_compression + cycle.dissipated_restitution;
  };
  EXPECT_NEAR(loss(1e-4, 0.9), loss(8e-5, 0.7), 1e-15);
  EXPECT_NEAR(loss(1e-4, 0.9), 0.3 - Energy(1e-5), 1e-15);
}

}  // namespace
}  // namespace contact
