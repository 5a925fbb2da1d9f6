#pragma once

#include <random>
#include <string>
#include <vector>

#include "simulation/run.h"

namespace contact::testing {

/// Whether this is the build of preset release: solving the larger rows takes a hundred times
/// longer in an unoptimized build, and minutes under a sanitizer.
#ifdef NDEBUG
inline constexpr bool kOptimized = true;
#else
inline constexpr bool kOptimized = false;
#endif

/// A body of radius 0.05 m; the paper's balls weigh 0.5 kg.
inline Body Ball(double position, double velocity = 0, double mass = 0.5) {
  return {.name = std::string("B").append(std::to_string(position)),
          .mass = mass,
          .radius = 0.05,
          .position = position,
          .velocity = velocity};
}

/// Touching balls in a row, of which only the first moves.
inline Scenario Chain(const std::vector<double>& masses, const std::vector<double>& stiffnesses,
                      const std::vector<double>& restitutions, double velocity, double end_time) {
  Scenario s;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    s.bodies.push_back(Ball(0.1 * static_cast<double>(i), i == 0 ? velocity : 0, masses[i]));
  }
  for (std::size_t i = 0; i + 1 < masses.size(); ++i) {
    s.contacts.push_back({.name = std::string("C").append(std::to_string(i + 1)),
                          .left = static_cast<int>(i),
                          .right = static_cast<int>(i) + 1,
                          .stiffness = stiffnesses[i],
                          .restitution = restitutions[i]});
  }
  s.end_time = end_time;
  return s;
}

/// Three balls, a wall, a support between bodies and one to the ground: every kind of term.
inline Scenario Mixed() {
  Scenario s = Chain({0.5, 0.8, 0.3}, {1e8, 3e7}, {0.8, 0.7}, 0.2, 1);
  s.contacts.push_back({.name = "wall",
                        .right = 0,
                        .wall_position = -0.05,
                        .stiffness = 2e7,
                        .exponent = 1.2,
                        .restitution = 0.5});
  s.supports = {
      {.body = 0, .stiffness = 1e6, .damping = 300, .rest_position = 1e-5},
      {.body = 2, .other = 1, .stiffness = 2e6, .damping = 200, .rest_position = 0.09995}};
  s.loads = {{.body = 1, .constant = 40, .amplitude = 9, .angular_frequency = 70, .phase = 0.4}};
  return s;
}

/// The paper's 6.1.
inline Scenario TripleChain() { return Chain({0.5, 0.5, 0.5}, {1e8, 1e8}, {0.8, 0.7}, 0.2, 4e-3); }

/// The paper's 6.2.
inline Scenario SpringWall() {
  Scenario s;
  s.bodies = {Ball(-0.01)};
  s.contacts = {
      {.name = "wall", .left = 0, .wall_position = 0.048, .stiffness = 1.8e7, .restitution = 0.9}};
  s.supports = {{.body = 0, .stiffness = 1e6, .damping = 100}};
  s.loads = {{.body = 0, .constant = 500},
             {.body = 0, .amplitude = 250, .angular_frequency = 2000}};
  s.end_time = 0.035;
  return s;
}

/// A ball that hits a wall to its right at once.
inline Scenario Collision(double mass, double velocity, double stiffness, double exponent,
                          double restitution) {
  Scenario s;
  s.bodies = {Ball(-0.05, velocity, mass)};
  s.contacts = {{.name = "wall",
                 .left = 0,
                 .stiffness = stiffness,
                 .exponent = exponent,
                 .restitution = restitution}};
  s.end_time = 100 * MaximumDeformation(mass, velocity, stiffness, exponent, 0) / velocity;
  return s;
}

/// Balls of 30 g between two walls, in gaps of 2 to 30 mm times `spread`, at up to ±1 m/s, for 50
/// ms: most collisions happen alone.
inline Scenario Gas(int balls, double stiffness, unsigned seed, double spread = 1) {
  std::mt19937 random(seed);  // Its numbers are those of the standard, everywhere.
  const auto between = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  Scenario s;
  double x = 0;
  for (int i = 0; i < balls; ++i) {
    x += spread * between(2e-3, 30e-3) + 0.01;
    s.bodies.push_back({.name = std::string("B").append(std::to_string(i)),
                        .mass = 0.03,
                        .radius = 0.01,
                        .position = x,
                        .velocity = between(-1, 1)});
    s.contacts.push_back({.name = std::string("C").append(std::to_string(i)),
                          .left = i - 1,
                          .right = i,
                          .stiffness = stiffness,
                          .restitution = 0.9});
    x += 0.01;
  }
  s.contacts.push_back({.name = "end",
                        .left = balls - 1,
                        .wall_position = x + spread * between(2e-3, 30e-3),
                        .stiffness = stiffness,
                        .restitution = 0.9});
  s.end_time = 0.05;
  return s;
}

/// Balls of 30 g that fall onto a floor to their right, the lowest from `gap`, as far apart [m].
inline Scenario Column(int balls, double stiffness, double restitution, double gap) {
  Scenario s;
  for (int i = 0; i < balls; ++i) {
    s.bodies.push_back({.name = std::string("B").append(std::to_string(i)),
                        .mass = 0.03,
                        .radius = 0.01,
                        .position = -0.01 - gap - (0.02 + gap) * (balls - 1 - i)});
    s.loads.push_back({.body = i, .constant = 9.81 * 0.03});
    s.contacts.push_back({.name = std::string("C").append(std::to_string(i)),
                          .left = i,
                          .right = i + 1 < balls ? i + 1 : kNone,
                          .stiffness = stiffness,
                          .restitution = restitution});
  }
  s.end_time = 0.3;
  return s;
}

/// A ball of 0.5 kg that falls 0.15 m onto a floor, and bounces for a second.
inline Scenario BouncingBall() {
  Scenario s;
  s.bodies = {Ball(0.2)};
  s.contacts = {{.name = "floor", .right = 0, .stiffness = 1e8, .restitution = 0.8}};
  s.loads = {{.body = 0, .constant = -0.5 * 9.81}};
  s.end_time = 1;
  return s;
}

/// Keeps everything that a run reports.
struct Record : Observer {
  std::vector<Iteration> iterations;
  std::vector<Cycle> cycles;
  std::vector<Group> groups;
  std::vector<Group> growths;
  std::vector<double> samples;
  int columns = 0;
  std::vector<std::string> warnings;
  Outcome outcome;

  void OnIteration(const Iteration& i) override { iterations.push_back(i); }
  void OnCycle(const Cycle& c) override { cycles.push_back(c); }
  void OnGroup(const Group& g) override { groups.push_back(g); }
  void OnGrowth(const Group& g) override { growths.push_back(g); }
  void OnSamples(const Samples& s) override {
    columns = s.columns;
    samples.insert(samples.end(), s.values.begin(), s.values.end());
  }
  void OnWarning(const std::string& text) override { warnings.push_back(text); }

  int rows() const { return columns == 0 ? 0 : static_cast<int>(samples.size()) / columns; }
  double Sample(int row, int column) const {
    return samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column)];
  }
};

inline Record RunAndRecord(const Scenario& scenario) {
  Record record;
  record.outcome = Run(scenario, record);
  return record;
}

/// That of a run whose bodies all move together, however many they are.
inline Record RunTogether(const Scenario& scenario) {
  Record record;
  record.outcome = RunWhole(scenario, record);
  return record;
}

}  // namespace contact::testing
