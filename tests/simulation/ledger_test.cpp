// Properties of every row of the ledger, in rows of touching bodies under loads.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "testing/cases.h"

namespace contact {
namespace {

// Five touching balls; a sine load parts two of them while a shock arrives from either side.
Scenario PartedByALoad() {
  Scenario s;
  s.bodies = {
      {.name = "B1", .mass = 2.5947, .radius = 0.04091, .position = 0.0, .velocity = 0.539},
      {.name = "B2", .mass = 0.0427, .radius = 0.00902, .position = 0.04993},
      {.name = "B3", .mass = 0.1466, .radius = 0.05909, .position = 0.11804},
      {.name = "B4", .mass = 1.3481, .radius = 0.01528, .position = 0.19241},
      {.name = "B5", .mass = 2.0862, .radius = 0.00868, .position = 0.21637, .velocity = -0.499}};
  s.contacts = {
      {.name = "B1-B2", .left = 0, .right = 1, .stiffness = 27070500.4, .restitution = 0.816},
      {.name = "B2-B3", .left = 1, .right = 2, .stiffness = 1573368.0, .restitution = 0.764},
      {.name = "B3-B4", .left = 2, .right = 3, .stiffness = 124867266.5, .restitution = 0.975},
      {.name = "B4-B5", .left = 3, .right = 4, .stiffness = 86504288.8, .restitution = 0.358}};
  s.supports = {{.body = 3, .stiffness = 32053.7, .damping = 16.78, .rest_position = 0.19241}};
  s.loads = {{.body = 2, .amplitude = 82.2, .angular_frequency = 624.8}};
  s.end_time = 0.0183;
  return s;
}

// A row of two to six touching balls at rest or in motion, pulled and pushed by sines and
// constants.
Scenario RandomTouchingRow(unsigned seed) {
  std::mt19937 engine(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  Scenario s;
  const int count = 2 + static_cast<int>(uniform(0, 5));
  double face = 0;
  for (int i = 0; i < count; ++i) {
    const double radius = uniform(0.005, 0.06);
    s.bodies.push_back({.name = std::to_string(i),
                        .mass = std::exp(uniform(std::log(0.05), std::log(5))),
                        .radius = radius,
                        .position = face + radius,
                        .velocity = uniform(0, 1) < 0.4 ? uniform(-1, 1) : 0});
    face += 2 * radius;
    if (i == 0) continue;
    s.contacts.push_back({.name = std::to_string(i),
                          .left = i - 1,
                          .right = i,
                          .stiffness = std::exp(uniform(std::log(1e6), std::log(1e9))),
                          .restitution = uniform(0.3, 0.99)});
  }
  for (int i = 0; i < count; ++i) {
    if (uniform(0, 1) < 0.5) continue;
    Load load{.body = i};
    if (uniform(0, 1) < 0.3) load.constant = uniform(-100, 100);
    if (load.constant == 0) load.amplitude = uniform(-100, 100);
    load.angular_frequency = uniform(200, 2000);
    s.loads.push_back(load);
  }
  if (uniform(0, 1) < 0.5) {
    const int held = count / 2;
    s.supports = {{.body = held,
                   .stiffness = uniform(1e3, 1e5),
                   .damping = uniform(0, 50),
                   .rest_position = s.bodies[static_cast<std::size_t>(held)].position}};
  }
  s.end_time = 0.01;
  return s;
}

void ExpectThatEveryCycleLastsAndDoesWork(const Scenario& scenario) {
  const testing::Record r = testing::RunAndRecord(scenario);
  EXPECT_EQ(r.outcome.end, Outcome::End::kFinished) << r.outcome.message;
  EXPECT_LT(r.outcome.energy_residual, 1e-8);
  EXPECT_LT(r.outcome.momentum_residual, 1e-8);
  std::vector<int> numbers(scenario.contacts.size());
  for (const Cycle& c : r.cycles) {
    EXPECT_GT(c.end_time, c.start_time) << c.contact << " #" << c.number;
    const bool rested = c.status == Cycle::Status::kSettled;  // Or negligible.
    const bool hidden = std::isnan(c.work_compression);       // By the end of the run.
    if (!rested && !hidden && c.status != Cycle::Status::kReleased) {
      EXPECT_GT(c.work_compression, 0) << c.contact << " #" << c.number << " at " << c.start_time;
    }
    EXPECT_NE(c.work_compression + c.work_restitution, 0)
        << c.contact << " #" << c.number << " at " << c.start_time;
    EXPECT_EQ(c.number, ++numbers[static_cast<std::size_t>(c.contact)]) << c.contact;
  }
}

TEST(Ledger, EveryCycleLastsAndDoesWork) {
  ExpectThatEveryCycleLastsAndDoesWork(PartedByALoad());
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    ExpectThatEveryCycleLastsAndDoesWork(RandomTouchingRow(seed));
  }
}

}  // namespace
}  // namespace contact
