#include "simulation/campaign/result.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "simulation/kinds/catalogue.h"
#include "simulation/proof/promises.h"

namespace contact::campaign {
namespace {

using Status = Result::Status;

// A ledger without the iterations, which would fill the memory of a run of millions of steps.
struct Ledger final : testing::Record {
  std::int64_t passes = 0;
  void OnIteration(const Iteration&) override { ++passes; }
  void OnGrowth(const Group&) override {}
};

constexpr const char* kEnds[] = {"FINISHED", "STOPPED", "NUMERIC", "BUDGET_STEPS", "NOT_CONVERGED"};
constexpr const char* kCycleStatuses[] = {"CONVERGED",     "GIVEN_LAW", "INFEASIBLE", "SETTLED",
                                          "NOT_CONVERGED", "JUMP",      "UNFINISHED", "RELEASED",
                                          "LIMITED",       "CUT"};

template <class Names, class Value>
const char* NameIn(const Names& names, Value value) {
  return names[static_cast<std::size_t>(value)];
}

double ProcessorMs() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Status StatusOf(const Outcome& outcome) {
  if (outcome.end == Outcome::End::kBudgetSteps) return Status::kBudget;
  if (outcome.end != Outcome::End::kFinished) return Status::kFailed;
  return outcome.all_converged ? Status::kFull : Status::kPartial;
}

void Count(const Ledger& run, Result& result) {
  int counts[std::size(kCycleStatuses)] = {};
  for (const Cycle& c : run.cycles) ++counts[static_cast<int>(c.status)];
  for (std::size_t i = 0; i < std::size(kCycleStatuses); ++i) {
    if (counts[i] > 0) result.cycles.emplace_back(kCycleStatuses[i], counts[i]);
  }
  result.released = counts[static_cast<int>(Cycle::Status::kReleased)];
  result.cut = counts[static_cast<int>(Cycle::Status::kCut)];
  result.groups = static_cast<int>(run.groups.size());
  for (const Group& g : run.groups) {
    result.longest = std::max(result.longest, g.cycles);
    result.jumps += g.status == Cycle::Status::kJump;
    result.limited += g.status == Cycle::Status::kLimited;
    const double miss = testing::IsAnswered(g) ? testing::MissOf(g) : 0;
    if (!(miss <= result.restitution)) result.restitution = miss;
  }
}

void Copy(const Outcome& outcome, Result& result) {
  result.status = StatusOf(outcome);
  result.end = NameIn(kEnds, outcome.end);
  result.message = outcome.message;
  result.time = outcome.time;
  result.iterations = outcome.iterations;
  result.growths = outcome.growths;
  result.steps = outcome.steps;
  result.evaluations = outcome.evaluations;
  result.identity = outcome.worst_identity_residual;
  result.momentum = outcome.momentum_residual;
  result.energy = outcome.energy_residual;
}

}  // namespace

Scenario ScenarioOf(int kind, unsigned seed, const Options& options) {
  Scenario scenario = testing::RollKind(kind, seed);
  scenario.solver.restitution_scope = options.scope;
  if (options.max_steps > 0) scenario.solver.max_steps = options.max_steps;
  return scenario;
}

Result RunOne(int kind, unsigned seed, const Options& options) {
  const Scenario scenario = ScenarioOf(kind, seed, options);
  Result result;
  result.kind = testing::NameOfKind(kind);
  result.seed = seed;
  result.end_time = scenario.end_time;
  result.bodies = static_cast<int>(scenario.bodies.size());
  Ledger run;
  const double start = ProcessorMs();
  run.outcome = Run(scenario, run);
  result.ms = ProcessorMs() - start;
  Copy(run.outcome, result);
  Count(run, result);
  result.passes = run.passes;
  result.broken = testing::BrokenPromises(scenario, run);
  return result;
}

}  // namespace contact::campaign
