// The independent integration finds what the ledger says where it is right, and tells where not.
#include "simulation/proof/independent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace contact::testing {
namespace {

struct WrongRun {
  const char* what;
  double Disagreement::*which;
  std::function<void(Record&)> make;
};
void PrintTo(const WrongRun& fault, std::ostream* out) { *out << fault.what; }

class EveryError : public ::testing::TestWithParam<WrongRun> {};

// 0.1 ppm of the second contact of the paper's chain.
TEST_P(EveryError, OfALedgerIsSeen) {
  const Scenario s = TripleChain();
  Record run = RunAndRecord(s);
  ASSERT_LT(CompareWithIndependent(s, run).worst, 1e-10);
  GetParam().make(run);
  const Disagreement miss = CompareWithIndependent(s, run);
  EXPECT_GT(miss.*GetParam().which, 2e-8);
  EXPECT_GT(miss.sure, 1e-10);
  EXPECT_NE(miss.where, "");
}

INSTANTIATE_TEST_SUITE_P(
    Independent, EveryError,
    ::testing::Values(
        WrongRun{"Restitution", &Disagreement::restitution,
                 [](Record& r) { r.groups[1].restitution_out *= 1 + 1e-7; }},
        WrongRun{"Mu", &Disagreement::restitution, [](Record& r) { r.cycles[1].mu *= 1 + 1e-6; }},
        WrongRun{"Work", &Disagreement::work,
                 [](Record& r) { r.groups[1].work_compression *= 1 + 1e-7; }},
        WrongRun{"Rest", &Disagreement::rest,
                 [](Record& r) { r.cycles[0].kind = Cycle::Kind::kNirv; }},
        WrongRun{"Velocity", &Disagreement::velocity,
                 [](Record& r) { r.outcome.velocities[2] *= 1 + 1e-7; }},
        WrongRun{"Turn", &Disagreement::time, [](Record& r) { r.cycles[1].turn_time *= 1 + 1e-6; }},
        WrongRun{"Approach", &Disagreement::approach,
                 [](Record& r) { r.cycles[0].approach_velocity *= 1 + 1e-6; }},
        WrongRun{"Touch", &Disagreement::overlap, [](Record& r) { r.cycles.pop_back(); }}),
    [](const auto& made) { return std::string(made.param.what); });

// Half of a swing under a load is a closed form: the works of a ball put on a linear spring.
TEST(Independent, FollowsABallThatIsPutOnALinearSpring) {
  Scenario s;
  s.bodies = {Ball(-0.05, 0, 2)};
  s.contacts = {{.name = "wall", .left = 0, .stiffness = 8e4, .exponent = 1, .restitution = 1}};
  s.loads = {{.body = 0, .constant = 20}};
  s.end_time = 0.1;
  const Record run = RunAndRecord(s);
  ASSERT_TRUE(run.outcome.all_converged);
  EXPECT_LT(CompareWithIndependent(s, run).worst, 1e-9);
  EXPECT_NEAR(run.outcome.velocities[0], 20.0 / 2 / 200 * std::sin(200 * 0.1), 1e-9);
}

TEST(Independent, IntegratesACreepThatAnExplicitMethodCouldNot) {
  Scenario s;
  s.bodies = {Ball(-0.05, 1, 1)};
  s.contacts = {
      {.name = "wall", .left = 0, .stiffness = 1e6, .damping = DampingLaw::kGiven, .mu = 1e12}};
  s.loads = {{.body = 0, .constant = 10}};
  s.end_time = 1;
  const Record run = RunAndRecord(s);
  ASSERT_EQ(run.outcome.end, Outcome::End::kFinished);
  const Disagreement miss = CompareWithIndependent(s, run);
  EXPECT_EQ(miss.checked_until, s.end_time);
  EXPECT_LT(miss.steps, 20'000);
  EXPECT_LT(miss.velocity, 1e-8);
}

TEST(Independent, SaysWhereItGaveUp) {
  const Scenario s = SpringWall();
  const Record run = RunAndRecord(s);
  const Disagreement miss = CompareWithIndependent(s, run, 100);
  EXPECT_LT(miss.checked_until, s.end_time);
  EXPECT_LT(miss.worst, 1e-8);
}

TEST(Independent, SeesAMuThatDoesNotFollowFromTheLaw) {
  Scenario s = TripleChain();
  s.contacts[0].damping = DampingLaw::kFlores;
  Record run = RunAndRecord(s);
  EXPECT_LT(CompareWithIndependent(s, run).law, 1e-12);
  run.cycles[0].mu *= 1 + 1e-6;
  EXPECT_GT(CompareWithIndependent(s, run).law, 1e-7);
}

}  // namespace
}  // namespace contact::testing
