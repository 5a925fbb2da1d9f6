// Accelerations, forces and energies that a trajectory tells, at every sample.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kinds/catalogue.h"
#include "simulation/model/derived.h"
#include "simulation/model/index.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Record;
using testing::RunAndRecord;

// The columns of a scenario by what they tell.
struct Columns {
  explicit Columns(const Scenario& s)
      : bodies(static_cast<int>(s.bodies.size())),
        contacts(static_cast<int>(s.contacts.size())),
        all(SampleColumns(s)) {}
  int Velocity(int body) const { return 2 + 2 * body; }
  int Force(int contact) const { return 3 + 2 * bodies + 4 * contact; }
  int Acceleration(int body) const { return 1 + 2 * bodies + 4 * contacts + body; }
  int Support(int support) const { return Acceleration(bodies) + 2 * support; }
  int Kinetic() const { return all - 5; }
  int Contacts() const { return all - 4; }
  int Supports() const { return all - 3; }
  int Dissipated() const { return all - 2; }
  int Work() const { return all - 1; }

  int bodies, contacts, all;
};

// The largest change of kinetic + contact + support energy + dissipated − work between samples,
// relative to the largest of these.
double WorstBalance(const Record& r) {
  const int last = r.columns;
  double worst = 0, scale = 0;
  const auto sum = [&](int row) {
    double all = -r.Sample(row, last - 1);
    for (int column = last - 5; column < last - 1; ++column) all += r.Sample(row, column);
    return all;
  };
  for (int row = 0; row < r.rows(); ++row) {
    worst = std::max(worst, std::abs(sum(row) - sum(0)));
    for (int c = last - 5; c < last; ++c) scale = std::max(scale, std::abs(r.Sample(row, c)));
  }
  return scale > 0 ? worst / scale : worst;
}

void Sampled(Scenario* s, int samples = 200) {
  s->sample_interval = s->end_time / samples;
  s->samples_per_contact = 10;
  s->turning_channels = static_cast<int>(s->contacts.size() + 2 * s->bodies.size());
}

class Balance : public ::testing::TestWithParam<int> {};

// Rows, walls, supports, loads, drives, rests and releases. What the run's own balance misses, as
// after millions of steps, samples miss too.
TEST_P(Balance, IsClosedAtEverySample) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    Scenario s = testing::RollKind(GetParam(), seed);
    Sampled(&s);
    s.solver.max_steps = 500'000;
    const Record r = RunAndRecord(s);
    ASSERT_GT(r.rows(), 0);
    ASSERT_EQ(r.columns, SampleColumns(s));
    EXPECT_LT(WorstBalance(r), 1e-9 + 10 * r.outcome.energy_residual) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Balance, ::testing::Range(0, testing::KindCount()),
                         [](const auto& kind) {
                           std::string name(testing::NameOfKind(kind.param));
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

// In a column under gravity with its rests, and in a gas; also where samples lie within cycles.
TEST(Channels, OfWhatIsSolvedInClustersAreBalanced) {
  for (Scenario s : {testing::Column(9, 1e7, 0.5, 0.001), testing::Gas(20, 1e6, 2)}) {
    Sampled(&s);
    s.solver.max_steps = 200'000;
    const Record r = RunAndRecord(s);
    ASSERT_TRUE(MayPart(s));
    EXPECT_LT(WorstBalance(r), 1e-9);
    EXPECT_GT(r.Sample(r.rows() - 1, Columns(s).Dissipated()), 0);
  }
}

// x = A cos ωt: ẍ = −ω² x, the force of the spring m ẍ, its energy ½ k x².
TEST(Channels, OfAnOscillatorAreThoseOfItsClosedForm) {
  const double mass = 2, omega = 30, amplitude = 0.01;
  Scenario s;
  s.bodies = {{.name = "B", .mass = mass, .position = amplitude}};
  s.supports = {{.body = 0, .stiffness = mass * omega * omega}};
  s.end_time = 1;
  Sampled(&s);
  const Record r = RunAndRecord(s);
  const Columns at(s);
  const double energy = 0.5 * mass * std::pow(amplitude * omega, 2);
  for (int row = 0; row < r.rows(); ++row) {
    const double phase = omega * r.Sample(row, 0);
    const double acceleration = -amplitude * omega * omega * std::cos(phase);
    EXPECT_NEAR(r.Sample(row, at.Acceleration(0)), acceleration, 1e-8);
    EXPECT_NEAR(r.Sample(row, at.Support(0)), mass * acceleration, 1e-8);
    EXPECT_NEAR(r.Sample(row, at.Support(0) + 1), energy * std::pow(std::cos(phase), 2), 1e-9);
    EXPECT_NEAR(r.Sample(row, at.Supports()), energy * std::pow(std::cos(phase), 2), 1e-9);
    EXPECT_NEAR(r.Sample(row, at.Kinetic()), energy * std::pow(std::sin(phase), 2), 1e-9);
    EXPECT_EQ(r.Sample(row, at.Dissipated()), 0);
  }
}

// m ẍ = ΣF, where forces are the samples of the contacts: the bodies of a chain.
TEST(Channels, AccelerationsAreThoseOfTheForces) {
  Scenario s = testing::TripleChain();
  Sampled(&s);
  const Record r = RunAndRecord(s);
  const Columns at(s);
  for (int row = 0; row < r.rows(); ++row) {
    const double left = r.Sample(row, at.Force(0)), right = r.Sample(row, at.Force(1));
    EXPECT_NEAR(r.Sample(row, at.Acceleration(0)), -left / 0.5, 1e-9);
    EXPECT_NEAR(r.Sample(row, at.Acceleration(1)), (left - right) / 0.5, 1e-9);
    EXPECT_NEAR(r.Sample(row, at.Acceleration(2)), right / 0.5, 1e-9);
  }
}

// A driven body moves as its formula says, and so does its acceleration (M7).
TEST(Channels, ADrivenBodyHasTheAccelerationOfItsMotion) {
  Scenario s;
  s.bodies = {{.name = "mass", .mass = 3}, {.name = "base", .velocity = 0.066, .fixed = true}};
  s.supports = {{.body = 0, .other = 1, .stiffness = 1200, .damping = 5}};
  s.drives = {{.body = 1, .amplitude = 2e-3, .angular_frequency = 33}};
  s.end_time = 1;
  Sampled(&s);
  const Record r = RunAndRecord(s);
  const Columns at(s);
  for (int row = 0; row < r.rows(); ++row) {
    const double t = r.Sample(row, 0);
    EXPECT_NEAR(r.Sample(row, at.Acceleration(1)), -2e-3 * 33 * 33 * std::sin(33 * t), 1e-12);
    EXPECT_NEAR(3 * r.Sample(row, at.Acceleration(0)), r.Sample(row, at.Support(0)), 1e-9);
  }
  EXPECT_LT(WorstBalance(r), 1e-9);
  EXPECT_GT(r.Sample(r.rows() - 1, at.Dissipated()), 0);
}

// What is dissipated at the end is what the rows of the ledger say.
TEST(Channels, DissipatedEnergyEndsWithTheSumOfTheLedger) {
  Scenario s = testing::TripleChain();
  Sampled(&s);
  const Record r = RunAndRecord(s);
  double sum = 0;
  for (const Cycle& cycle : r.cycles) {
    sum += cycle.dissipated_compression + cycle.dissipated_restitution;
  }
  const Columns at(s);
  EXPECT_NEAR(r.Sample(r.rows() - 1, at.Dissipated()), sum, 1e-12 * sum);
  for (int row = 1; row < r.rows(); ++row) {
    EXPECT_GE(r.Sample(row, at.Dissipated()), r.Sample(row - 1, at.Dissipated()) - 1e-15 * sum);
  }
}

}  // namespace
}  // namespace contact
