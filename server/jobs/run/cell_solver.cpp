#include "jobs/run/cell_solver.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <stop_token>
#include <string>
#include <utility>

#include "jobs/job/errors.h"
#include "jobs/job/lifecycle.h"
#include "wire/chunk_columns.h"
#include "wire/ledger_codec.h"
#include "wire/result_codec.h"

namespace contact {
namespace {

// Keeps of a run what metrics may ask for, and its samples if there is a place for them.
class CellObserver final : public Observer {
 public:
  CellObserver(const Scenario& scenario, RunControl& control, const Meanwhile& meanwhile,
               v1::Job* result, SeriesTally* series, std::vector<v1::FrameChunk>* trajectory)
      : scenario_(scenario),
        control_(control),
        meanwhile_(meanwhile),
        result_(result),
        series_(series),
        trajectory_(trajectory) {}

  void OnCycle(const Cycle& cycle) override { *result_->add_cycles() = Encode(scenario_, cycle); }
  void OnGroup(const Group& group) override { *result_->add_groups() = Encode(scenario_, group); }
  void OnSamples(const Samples& samples) override {
    series_->See(samples);
    if (trajectory_ == nullptr) return;
    std::ranges::move(SplitColumns(Encode(scenario_, samples)), std::back_inserter(*trajectory_));
  }
  void OnProgress(const Progress& /*progress*/) override { meanwhile_.write(); }
  // In batches: all workers count on the same number.
  void OnStep() override {
    if (++steps_ < kBatch) return;
    TellSteps();
    if (meanwhile_.leave()) stop_.request_stop();
  }

  void TellSteps() { control_.CountSteps(std::exchange(steps_, 0)); }

  // Of the cell: with the run, or before it.
  std::stop_token token() const { return stop_.get_token(); }

 private:
  static constexpr std::int64_t kBatch = 64;

  const Scenario& scenario_;
  RunControl& control_;
  const Meanwhile& meanwhile_;
  v1::Job* result_;
  SeriesTally* series_;
  std::vector<v1::FrameChunk>* trajectory_;
  std::stop_source stop_;
  const std::stop_callback<std::function<void()>> with_run_{control_.token(),
                                                            [this] { stop_.request_stop(); }};
  std::int64_t steps_ = 0;  // Not told yet.
};

void Fail(const std::string& reason, const std::string& message, v1::SweepCell* cell) {
  cell->set_state(v1::Job::FAILED);
  cell->set_state_reason(reason);
  cell->set_message(message);
}

}  // namespace

std::vector<v1::Event> ToEvents(SolvedCell solved, std::chrono::system_clock::time_point now) {
  std::vector<v1::Event> events;
  for (v1::FrameChunk& chunk : solved.trajectory) {
    *events.emplace_back(EventAt(now)).mutable_frame_chunk() = std::move(chunk);
  }
  *events.emplace_back(EventAt(now)).mutable_sweep_cell() = std::move(solved.cell);
  return events;
}

CellSolver::CellSolver(const v1::Sweep& sweep, const DecodedSweep& plan, const JobOptions& options)
    : sweep_(sweep), plan_(plan), options_(options), fields_(sweep, &none_) {}

std::optional<SolvedCell> CellSolver::Solve(std::int32_t index, RunControl& control,
                                            const Meanwhile& meanwhile) {
  SolvedCell solved;
  solved.cell.set_index(index);
  try {
    if (!Compute(control, meanwhile, &solved)) return std::nullopt;
  } catch (...) {
    const Transition transition = TransitionAfterException();
    Fail(transition.state_reason, transition.message, &solved.cell);
  }
  return solved;
}

bool CellSolver::Compute(RunControl& control, const Meanwhile& meanwhile, SolvedCell* solved) {
  v1::SweepCell* const cell = &solved->cell;
  std::vector<double> values = plan_.axes.Values(cell->index());
  DecodedScenario decoded = DecodeScenario(fields_.Set(values), options_.scenario_limits);
  cell->mutable_values()->Add(values.begin(), values.end());
  if (!decoded.violations.empty()) {
    const Violation& first = decoded.violations.front();
    Fail(InfoOf(Reason::kScenarioInvalid).name, first.field + ": " + first.description, cell);
    for (const auto& metric : plan_.metrics.Of({})) cell->add_metrics(metric.value);
    return true;
  }
  const auto& kept = sweep_.keep_trajectories();
  const bool keeps = std::ranges::find(kept, cell->index()) != kept.end();
  if (!keeps && !plan_.metrics.need_samples()) decoded.scenario.sample_interval = 0;
  return Run(decoded.scenario, keeps, control, meanwhile, solved);
}

bool CellSolver::Run(const Scenario& scenario, bool keeps, RunControl& control,
                     const Meanwhile& meanwhile, SolvedCell* solved) const {
  v1::Job result;
  SeriesTally series = plan_.metrics.Tally(scenario);
  CellObserver observer(scenario, control, meanwhile, &result, &series,
                        keeps ? &solved->trajectory : nullptr);
  const Outcome outcome = options_.run(scenario, observer, observer.token());
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
  cell.set_cycles(result.summary().cycles());
  cell.set_cycles_cut(result.summary().cycles_cut());
  for (const auto& metric : plan_.metrics.Of(result, series)) {
    cell.add_metrics(metric.value);
    cell.add_sources(metric.source);
  }
  return true;
}

}  // namespace contact
