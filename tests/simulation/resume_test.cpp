// A run that goes on from any of its boundaries is the run that never stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "simulation/episode/run_state.h"
#include "simulation/kinds/machines.h"
#include "testing/cases.h"

namespace contact {
namespace {

using testing::Ball;

// Boundaries of a scenario that are tried at most.
constexpr std::size_t kTried = 10;

// Writes down exactly what a run tells, line by line, and keeps its boundaries.
class Teller final : public Observer {
 public:
  struct Boundary {
    std::size_t line;
    RunState state;
  };
  std::vector<std::string> lines;
  std::vector<Boundary> boundaries;

  void OnIteration(const Iteration& i) override {
    Write("iteration", {double(i.episode), double(i.number), i.start_time, double(i.accepted)});
    for (const Iteration::Unknown& u : i.unknowns) {
      Write("unknown", {double(u.contact), double(u.number), u.mu, u.residual, u.bracket_low,
                        u.bracket_high, u.restitution_out, double(u.update)});
    }
  }
  void OnCycle(const Cycle& c) override {
    Write("cycle", {double(c.contact),
                    double(c.number),
                    double(c.episode),
                    double(c.kind),
                    double(c.end),
                    double(c.status),
                    double(c.iterations),
                    c.start_time,
                    c.turn_time,
                    c.end_time,
                    c.max_deformation,
                    c.end_deformation,
                    c.mu,
                    c.work_compression,
                    c.work_restitution,
                    c.dissipated_compression,
                    c.external_restitution,
                    c.restitution_out,
                    c.peak_force,
                    c.tension_time});
  }
  void OnGroup(const Group& g) override {
    Write("group", {double(g.contact), double(g.number), double(g.encounter), double(g.first_cycle),
                    double(g.cycles), double(g.end), double(g.status), double(g.growth),
                    g.start_time, g.end_time, g.mu, g.work_compression, g.work_restitution,
                    g.restitution_out, g.residual, g.too_much.mu, g.too_little.mu});
  }
  void OnGrowth(const Group& g) override {
    Write("growth", {double(g.contact), double(g.first_cycle), double(g.growth), g.mu});
  }
  void OnSamples(const Samples& s) override {
    Write("samples", {double(s.first)});
    Write("values", s.values);
  }
  void OnProgress(const Progress& p) override {
    Write("progress", {p.time, double(p.steps), double(p.cycles), double(p.iterations)});
  }
  void OnWarning(const std::string& text) override { lines.push_back(text); }
  void OnBoundary(const std::function<RunState()>& state) override {
    boundaries.push_back({lines.size(), state()});
  }
  void End(const Outcome& o) {
    Write("end",
          {double(o.end), o.time, double(o.all_converged), double(o.steps), double(o.evaluations),
           double(o.iterations), double(o.episodes), o.worst_identity_residual, o.momentum_residual,
           o.energy_residual, o.kinetic_energy});
    Write("positions", o.positions);
    Write("velocities", o.velocities);
  }

 private:
  void Write(const std::string& what, const std::vector<double>& numbers) {
    std::ostringstream line;
    line << what << std::hexfloat;
    for (const double number : numbers) line << ' ' << number;
    lines.push_back(line.str());
  }
};

// Bounces that die away until the ball lies on the ground, under its own weight.
Scenario BallThatComesToRest() {
  Scenario s;
  s.bodies = {Ball(-0.1, 0.5)};
  s.contacts = {{.name = "ground", .left = 0, .stiffness = 1e6, .restitution = 0.5}};
  s.loads = {{.body = 0, .constant = 5}};
  s.end_time = 0.6;
  return s;
}

std::vector<std::pair<std::string, Scenario>> Scenarios() {
  const auto pulses = std::ranges::find(testing::Machines(), "pulses", &testing::Machine::name);
  std::vector<std::pair<std::string, Scenario>> all = {
      {"chain", testing::TripleChain()},
      {"driven wall", testing::SpringWall()},
      {"comes to rest", BallThatComesToRest()},
      {"row", testing::Chain(std::vector<double>(6, 0.5), std::vector<double>(5, 1e8),
                             std::vector<double>(5, 0.8), 0.2, 0.01)}};
  Scenario slips = testing::SpringWall();
  slips.supports[0].slip_force = 400;
  all.emplace_back("spring that slips", slips);
  // Several episodes, that hand each other what they know.
  all.emplace_back("long row",
                   testing::Chain(std::vector<double>(30, 0.5), std::vector<double>(29, 1e8),
                                  std::vector<double>(29, 0.9), 0.2, 0.01));
  Scenario law = testing::SpringWall();
  law.contacts[0].damping = DampingLaw::kHuntCrossley;
  all.emplace_back("law that misses", law);
  Scenario paper = testing::SpringWall();
  paper.solver.update = UpdateRule::kPaperRatio;
  all.emplace_back("paper", paper);
  Scenario yields = BallThatComesToRest();
  yields.contacts[0].damping = DampingLaw::kForceTable;
  yields.contacts[0].stiffness = 2e5, yields.contacts[0].exponent = 1;
  yields.contacts[0].table = ForceTable({{1e-4, 10}, {1e-3, 200}}, {1e6, 500});
  yields.end_time = 0.3;
  all.emplace_back("table that yields", yields);
  all.emplace_back("solved again, finely", testing::Roll(*pulses, 93));
  for (auto& [name, scenario] : all) scenario.sample_interval = scenario.end_time / 700;
  for (std::size_t i = 0; i < 6; ++i) {
    all.emplace_back(all[i].first + ", sampled in cycles", all[i].second);
    all.back().second.samples_per_contact = 40;
  }
  all.back().second.most_contact_samples = 1000;  // Of the long row.
  // So many steps that chunks are handed out before they are full.
  all.emplace_back("slow row", testing::Chain({0.5, 0.5}, {1e8}, {0.8}, 0.2, 0.01));
  all.back().second.sample_interval = all.back().second.end_time / 700;
  all.back().second.solver.fixed_step = all.back().second.end_time / 200'000;
  all.emplace_back("gas", testing::Gas(40, 1e6, 1));
  all.emplace_back("dense gas", testing::Gas(12, 1e8, 1, 0.05));
  all.emplace_back("falling column", testing::Column(10, 1e7, 0.8, 0.001));
  all.back().second.end_time = 0.04;
  for (std::size_t i = all.size() - 3; i < all.size(); ++i) {
    all[i].second.sample_interval = all[i].second.end_time / 700;
    all[i].second.samples_per_contact = 10;
  }
  for (const std::size_t i : {1UL, 2UL, all.size() - 3, all.size() - 2}) {
    all.emplace_back(all[i].first + ", with extremes", all[i].second);
    Scenario& s = all.back().second;
    s.sample_interval = s.end_time / 7;
    s.samples_per_contact = 0;
    s.turning_channels = static_cast<int>(s.contacts.size() + 2 * s.bodies.size());
  }
  return all;
}

TEST(Resume, GoesOnAsIfItHadNeverStopped) {
  std::size_t resumed = 0;
  for (const auto& [name, scenario] : Scenarios()) {
    Teller whole;
    whole.End(contact::Run(scenario, whole));
    const std::size_t stride = whole.boundaries.size() / kTried + 1;
    for (std::size_t i = 0; i < whole.boundaries.size(); i += stride) {
      const Teller::Boundary& boundary = whole.boundaries[i];
      Teller rest;
      rest.End(contact::Resume(scenario, boundary.state, rest));
      const std::vector<std::string> expected(
          whole.lines.begin() + static_cast<std::ptrdiff_t>(boundary.line), whole.lines.end());
      ASSERT_EQ(rest.lines, expected) << name << ", after line " << boundary.line;
      ++resumed;
    }
  }
  EXPECT_GT(resumed, 20U);
}

}  // namespace
}  // namespace contact
