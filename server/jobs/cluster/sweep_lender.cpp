#include "jobs/cluster/sweep_lender.h"

#include <algorithm>
#include <utility>

namespace contact {
namespace {

// What a loan is to take one thread [s].
constexpr double kLoanTime = 0.5;
constexpr std::int32_t kMostCells = 1000;
// Loans that are out for each idle thread: one that is computed, and the next.
constexpr int kLoansEach = 2;
constexpr int kMostLoans = 64;

}  // namespace

void SweepLender::Look(Time now, const std::vector<Scheduler::OwnSweep>& own, int idle) {
  const MutexLock lock(mutex_);
  std::map<std::string, Sweep> sweeps;
  for (const Scheduler::OwnSweep& one : own) {
    auto known = sweeps_.extract(one.job);
    Sweep sweep =
        known && known.mapped().run == one.run ? std::move(known.mapped()) : Sweep{one.run};
    if (one.run->control()->stopping()) {
      for (const auto& [number, cells] : std::exchange(sweep.lent, {})) one.run->PutBack(cells);
    }
    Measure(now, &sweep);
    if (const std::vector<Loan> loans = LendSome(&sweep, idle); !loans.empty()) {
      store_.Lend(worker_, one.job, loans, [](const absl::StatusOr<bool>& /*lent*/) {});
    }
    sweep.waiting = one.run->waiting();
    if (!sweep.lent.empty() && !std::exchange(sweep.asking, true)) Settle(one.job, sweep);
    sweeps.emplace(one.job, std::move(sweep));
  }
  sweeps_ = std::move(sweeps);
}

void SweepLender::Measure(Time now, Sweep* sweep) const {
  const double passed = std::chrono::duration<double>(now - sweep->time).count();
  const auto begun = static_cast<double>(sweep->waiting - sweep->run->waiting());
  if (sweep->time != Time() && passed > 0 && begun >= 0) {
    const double pace = begun / passed / threads_;
    sweep->pace = sweep->pace == 0 ? pace : 0.7 * sweep->pace + 0.3 * pace;
  }
  sweep->time = now;
}

// Near the end the loans become smaller, so that all threads end together.
std::int32_t SweepLender::Size(const Sweep& sweep, int idle) const {
  const std::int32_t fair = sweep.run->waiting() / (2 * (threads_ + idle));
  const auto size = static_cast<std::int32_t>(sweep.pace * kLoanTime);
  return std::clamp(size, 1, std::clamp(fair, 1, kMostCells));
}

std::vector<Loan> SweepLender::LendSome(Sweep* sweep, int idle) {
  const auto most = static_cast<std::size_t>(std::min(kLoansEach * idle, kMostLoans));
  std::vector<Loan> loans;
  while (sweep->lent.size() < most && sweep->run->waiting() > threads_) {
    const auto cells = sweep->run->Lend(Size(*sweep, idle));
    if (!cells) break;
    loans.push_back({{}, 0, ++numbers_, cells->first, cells->last});
    sweep->lent.emplace(numbers_, *cells);
  }
  return loans;
}

void SweepLender::Settle(const std::string& job, const Sweep& sweep) {
  std::vector<std::int64_t> numbers;
  for (const auto& [number, cells] : sweep.lent) numbers.push_back(number);
  store_.SettleLoans(worker_, job, numbers, sweep.run->waiting() == 0,
                     [this, job](const absl::StatusOr<std::vector<LoanEnd>>& ends) {
                       TakeIn(job, ends.ok() ? *ends : std::vector<LoanEnd>());
                     });
}

void SweepLender::TakeIn(const std::string& job, const std::vector<LoanEnd>& ends) {
  const MutexLock lock(mutex_);
  const auto found = sweeps_.find(job);
  if (found == sweeps_.end()) return;
  Sweep& sweep = found->second;
  sweep.asking = false;
  for (const LoanEnd& end : ends) {
    const auto lent = sweep.lent.extract(end.number);
    if (!lent) continue;
    if (end.done) {
      sweep.run->Returned({.cells = lent.mapped().count(),
                           .failed = end.counts.failed,
                           .not_converged = end.counts.not_converged,
                           .steps = end.counts.steps});
    } else {
      sweep.run->PutBack(lent.mapped());
    }
  }
}

void SweepLender::TakeBack() {
  const MutexLock lock(mutex_);
  for (const auto& [job, sweep] : std::exchange(sweeps_, {})) {
    for (const auto& [number, cells] : sweep.lent) sweep.run->PutBack(cells);
  }
}

}  // namespace contact
