#include "simulation/campaign/result.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "simulation/kinds/catalogue.h"
#include "simulation/proof/independent.h"
#include "simulation/proof/ledger.h"
#include "simulation/proof/metamorphic.h"
#include "simulation/proof/promises.h"

namespace contact::campaign {
namespace {

using Status = Result::Status;

// How far an independent integration may be from the ledger, and with tension CLIP, whose kink the
// run does not land on.
constexpr double kAgreement = 1e-8, kClipped = 1e-6;
// How far answers may differ when the scenario is said in other words.
constexpr double kSameAnswer = 1e-6;

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

void Count(const testing::Record& run, Result& result) {
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

Check Certify(const Scenario& scenario, const testing::Record& run) {
  if (run.outcome.end != Outcome::End::kFinished) {
    return {Check::Verdict::kNotChecked, 0, "it did not finish"};
  }
  const testing::Disagreement miss = testing::CompareWithIndependent(scenario, run);
  const double bound = scenario.solver.clip_tension ? kClipped : kAgreement;
  Check check{Check::Verdict::kAgrees, miss.worst, miss.where};
  if (miss.sure > bound) {
    check.verdict = Check::Verdict::kDisagrees;
  } else if (!(check.worst <= bound)) {
    check.verdict = Check::Verdict::kNotChecked;
    check.what = "too sensitive to tell";
  } else if (miss.checked_until < run.outcome.time) {
    check.verdict = Check::Verdict::kNotChecked;
    check.what = "from " + std::to_string(miss.checked_until) + " s on: too many steps";
  }
  return check;
}

Check InOtherWords(const Scenario& scenario, const testing::Record& run) {
  if (StatusOf(run.outcome) != Status::kFull) {
    return {Check::Verdict::kNotChecked, 0, "it is not FULL"};
  }
  const testing::Difference found = testing::CompareWithOtherWords(scenario, run);
  const bool same = found.worst <= kSameAnswer;
  return {same ? Check::Verdict::kAgrees : Check::Verdict::kDisagrees, found.worst, found.where};
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
  const double start = ProcessorMs();
  const testing::Ledger run = testing::RunForLedger(scenario);
  result.ms = ProcessorMs() - start;
  Copy(run.outcome, result);
  Count(run, result);
  result.passes = run.passes;
  result.broken = testing::BrokenPromises(scenario, run);
  if (options.certify) result.certificate = Certify(scenario, run);
  if (options.metamorphic) result.metamorphic = InOtherWords(scenario, run);
  return result;
}

}  // namespace contact::campaign
