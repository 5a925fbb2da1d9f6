#include "jobs/run/cell_solver.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "jobs/job/errors.h"
#include "jobs/job/lifecycle.h"
#include "wire/ledger_codec.h"
#include "wire/result_codec.h"

namespace contact {
namespace {

// Keeps of a run what metrics may ask for, and its samples if it records any.
class CellObserver final : public Observer {
 public:
  CellObserver(const Scenario& scenario, RunControl& control, const std::function<void()>& write,
               v1::Job* result, std::vector<v1::FrameChunk>* trajectory)
      : scenario_(scenario),
        control_(control),
        write_(write),
        result_(result),
        trajectory_(trajectory) {}

  void OnCycle(const Cycle& cycle) override { *result_->add_cycles() = Encode(scenario_, cycle); }
  void OnGroup(const Group& group) override { *result_->add_groups() = Encode(scenario_, group); }
  void OnSamples(const Samples& samples) override {
    trajectory_->push_back(Encode(scenario_, samples));
  }
  void OnProgress(const Progress& /*progress*/) override { write_(); }
  // In batches: all workers count on the same number.
  void OnStep() override {
    if (++steps_ == kBatch) TellSteps();
  }

  void TellSteps() { control_.CountSteps(std::exchange(steps_, 0)); }

 private:
  static constexpr std::int64_t kBatch = 64;

  const Scenario& scenario_;
  RunControl& control_;
  const std::function<void()>& write_;
  v1::Job* result_;
  std::vector<v1::FrameChunk>* trajectory_;
  std::int64_t steps_ = 0;  // Not told yet.
};

void Fail(const std::string& reason, const std::string& message, v1::SweepCell* cell) {
  cell->set_state(v1::Job::FAILED);
  cell->set_state_reason(reason);
  cell->set_message(message);
}

}  // namespace

CellSolver::CellSolver(const v1::Sweep& sweep, const DecodedSweep& plan, const JobOptions& options)
    : sweep_(sweep), plan_(plan), options_(options), fields_(sweep, &none_) {}

std::optional<SolvedCell> CellSolver::Solve(std::int32_t index, RunControl& control,
                                            const std::function<void()>& write) {
  SolvedCell solved;
  solved.cell.set_index(index);
  try {
    if (!Compute(control, write, &solved)) return std::nullopt;
  } catch (...) {
    const Transition transition = TransitionAfterException();
    Fail(transition.state_reason, transition.message, &solved.cell);
  }
  return solved;
}

bool CellSolver::Compute(RunControl& control, const std::function<void()>& write,
                         SolvedCell* solved) {
  v1::SweepCell* const cell = &solved->cell;
  std::vector<double> values = plan_.axes.Values(cell->index());
  DecodedScenario decoded = DecodeScenario(fields_.Set(values), options_.scenario_limits);
  cell->mutable_values()->Add(values.begin(), values.end());
  if (!decoded.violations.empty()) {
    const Violation& first = decoded.violations.front();
    Fail(InfoOf(Reason::kScenarioInvalid).name, first.field + ": " + first.description, cell);
    for (const double metric : plan_.metrics.Of({})) cell->add_metrics(metric);
    return true;
  }
  const auto& kept = sweep_.keep_trajectories();
  if (std::ranges::find(kept, cell->index()) == kept.end()) decoded.scenario.sample_interval = 0;
  return Run(decoded.scenario, control, write, solved);
}

bool CellSolver::Run(const Scenario& scenario, RunControl& control,
                     const std::function<void()>& write, SolvedCell* solved) const {
  v1::Job result;
  CellObserver observer(scenario, control, write, &result, &solved->trajectory);
  const Outcome outcome = options_.run(scenario, observer, control.token());
  observer.TellSteps();
  const Transition transition = TransitionAfter(outcome);
  if (transition.to == v1::Job::CANCELLED) return false;
  EncodeOutcome(scenario, outcome, &result);
  if (outcome.end != Outcome::End::kFinished) result.clear_convergence();
  v1::SweepCell& cell = solved->cell;
  cell.set_state(transition.to);
  cell.set_state_reason(transition.state_reason);
  cell.set_message(transition.message);
  cell.set_convergence(result.convergence());
  for (const double metric : plan_.metrics.Of(result)) cell.add_metrics(metric);
  return true;
}

}  // namespace contact
