// Whatever breaks a promise in a ledger is told, and nothing else.
#include "simulation/proof/promises.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace contact::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(Promises, AreKeptByTheTripleChain) {
  const Scenario s = TripleChain();
  EXPECT_THAT(BrokenPromises(s, RunAndRecord(s)), IsEmpty());
}

struct FalseWord {
  const char* told;
  std::function<void(Record&)> make;
};
void PrintTo(const FalseWord& fault, std::ostream* out) { *out << fault.told; }

class EveryFault : public ::testing::TestWithParam<FalseWord> {};

TEST_P(EveryFault, OfALedgerIsTold) {
  const Scenario s = TripleChain();
  Record run = RunAndRecord(s);
  GetParam().make(run);
  EXPECT_THAT(BrokenPromises(s, run), ElementsAre(StartsWith(GetParam().told)));
}

// A guess that holds the first two balls together.
void Glue(Record& run) {
  Group& g = run.groups[0];
  g.status = Cycle::Status::kUnfinished, g.end = Cycle::End::kRunEnd, g.mu *= 1e7;
}

INSTANTIATE_TEST_SUITE_P(
    Promises, EveryFault,
    ::testing::Values(
        FalseWord{"restitution", [](Record& r) { r.groups[1].work_restitution *= 1 + 1e-7; }},
        FalseWord{"identity", [](Record& r) { r.outcome.worst_identity_residual = 2e-7; }},
        FalseWord{"energy", [](Record& r) { r.outcome.energy_residual = 2e-8; }},
        FalseWord{"momentum", [](Record& r) { r.outcome.momentum_residual = kNaN; }},
        FalseWord{"end time", [](Record& r) { r.outcome.time *= 0.999; }},
        FalseWord{"failed", [](Record& r) { r.outcome.end = Outcome::End::kNumeric; }},
        FalseWord{"finite", [](Record& r) { r.outcome.velocities[2] = kNaN; }},
        FalseWord{"instants", [](Record& r) { r.cycles[0].turn_time = 3e-3; }},
        FalseWord{"order", [](Record& r) { r.cycles[1].end_time = 1.6e-3; }},
        FalseWord{"overlap", [](Record& r) { r.cycles[1].contact = 0, r.cycles[1].number = 2; }},
        FalseWord{"number", [](Record& r) { r.cycles[1].number = 2; }},
        FalseWord{"values", [](Record& r) { r.cycles[1].mu = -1; }},
        FalseWord{"compression", [](Record& r) { r.cycles[0].work_compression = 0; }},
        FalseWord{"glued", Glue},
        FalseWord{"unfinished",
                  [](Record& r) { r.groups[0].status = Cycle::Status::kUnfinished; }}),
    [](const auto& made) {
      std::string name = made.param.told;
      std::erase(name, ' ');
      return name;
    });

TEST(Promises, OfRestitutionAreThoseOfFullRuns) {
  const Scenario s = TripleChain();
  Record run = RunAndRecord(s);
  run.groups[1].work_restitution *= 0.9;
  run.outcome.all_converged = false;
  EXPECT_THAT(BrokenPromises(s, run), IsEmpty());
}

}  // namespace
}  // namespace contact::testing
