#include "jobs/cell_solver.h"

#include <string>
#include <utility>

#include "jobs/lifecycle.h"
#include "wire/result_codec.h"

namespace contact {
namespace {

// Keeps of a run what metrics may ask for.
class CellObserver final : public Observer {
 public:
  CellObserver(const Scenario& scenario, RunControl& control, const std::function<void()>& pulse,
               v1::Job* result)
      : scenario_(scenario), control_(control), pulse_(pulse), result_(result) {}

  void OnCycle(const Cycle& cycle) override { *result_->add_cycles() = Encode(scenario_, cycle); }
  void OnProgress(const Progress& /*progress*/) override { pulse_(); }
  void OnStep() override { control_.CountStep(); }

 private:
  const Scenario& scenario_;
  RunControl& control_;
  const std::function<void()>& pulse_;
  v1::Job* result_;
};

void Fail(const std::string& reason, const std::string& message, v1::SweepCell* cell) {
  cell->set_state(v1::Job::FAILED);
  cell->set_state_reason(reason);
  cell->set_message(message);
}

}  // namespace

CellSolver::CellSolver(const v1::Sweep& sweep, const DecodedSweep& plan,
                       const JobManagerOptions& options)
    : plan_(plan), options_(options), fields_(sweep, &none_) {}

std::optional<v1::SweepCell> CellSolver::Solve(std::int32_t index, RunControl& control,
                                               const std::function<void()>& pulse) {
  v1::SweepCell cell;
  cell.set_index(index);
  try {
    if (!Compute(control, pulse, &cell)) return std::nullopt;
  } catch (...) {
    const Move move = MoveAfterException();
    Fail(move.state_reason, move.message, &cell);
  }
  return cell;
}

bool CellSolver::Compute(RunControl& control, const std::function<void()>& pulse,
                         v1::SweepCell* cell) {
  std::vector<double> values = plan_.axes.Values(cell->index());
  DecodedScenario decoded = DecodeScenario(fields_.Set(values), options_.scenario_limits);
  cell->mutable_values()->Add(values.begin(), values.end());
  if (!decoded.violations.empty()) {
    const Violation& first = decoded.violations.front();
    Fail("SCENARIO_INVALID", first.field + ": " + first.description, cell);
    for (const double metric : plan_.metrics.Of({})) cell->add_metrics(metric);
    return true;
  }
  decoded.scenario.sample_interval = 0;  // No trajectory.
  return Run(decoded.scenario, control, pulse, cell);
}

bool CellSolver::Run(const Scenario& scenario, RunControl& control,
                     const std::function<void()>& pulse, v1::SweepCell* cell) const {
  v1::Job result;
  CellObserver observer(scenario, control, pulse, &result);
  const Outcome outcome = options_.run(scenario, observer, control.token());
  const Move move = MoveAfter(outcome);
  if (move.to == v1::Job::CANCELLED) return false;
  EncodeOutcome(scenario, outcome, &result);
  if (outcome.end != Outcome::End::kFinished) result.clear_convergence();
  cell->set_state(move.to);
  cell->set_state_reason(move.state_reason);
  cell->set_message(move.message);
  cell->set_convergence(result.convergence());
  for (const double metric : plan_.metrics.Of(result)) cell->add_metrics(metric);
  return true;
}

}  // namespace contact
