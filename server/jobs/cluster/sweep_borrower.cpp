#include "jobs/cluster/sweep_borrower.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace contact {
namespace {

using namespace std::chrono_literals;

// How often loans are asked for of which no note has told.
constexpr auto kLoanAskTime = 1s;
// A loan is given back when the workers have had something else to do for so long.
constexpr auto kLoanBusyTime = 1s;

// What the last cells of a loan take to be released.
constexpr auto kEndTime = 10ms;

// All cells of the sweep but those of the loan count as done.
std::vector<bool> AllBut(const Loan& loan, std::int32_t cells) {
  std::vector<bool> done(static_cast<std::size_t>(cells), true);
  for (std::int32_t cell = loan.first; cell <= loan.last; ++cell) {
    done[static_cast<std::size_t>(cell)] = false;
  }
  return done;
}

void Count(const v1::SweepCell& cell, LoanCounts* counts) {
  if (cell.state() == v1::Job::FAILED) {
    ++counts->failed;
  } else if (cell.convergence() != v1::Job::FULL) {
    ++counts->not_converged;
  }
}

}  // namespace

SweepBorrower::SweepBorrower(SharedStore& store, const Clock& clock, const JobOptions& options,
                             std::string worker, Scheduler& scheduler, std::function<void()> wake)
    : store_(store),
      clock_(clock),
      options_(options),
      worker_(std::move(worker)),
      scheduler_(scheduler),
      wake_(std::move(wake)) {}

bool SweepBorrower::busy() const {
  const MutexLock lock(mutex_);
  return loan_.has_value();
}

void SweepBorrower::Look(Time now) {
  std::optional<std::pair<Loan, v1::Job>> fetched;
  bool asking = false;
  {
    const MutexLock lock(mutex_);
    fetched.swap(fetched_);
    asking = asking_;
  }
  if (fetched) return Begin(fetched->first, fetched->second);
  if (asking) return;
  if (work_) {
    if (work_->run->AwaitEnd(kEndTime)) return Return();
    if (scheduler_.demand().running < options_.workers) busy_since_ = now;
    if (now - busy_since_ >= kLoanBusyTime) Refuse(work_->loan);
    return;
  }
  if (scheduler_.idle() <= 0 ||
      !(loans_wait_.exchange(false) || now - last_take_ >= kLoanAskTime)) {
    return;
  }
  last_take_ = now;
  Take();
}

void SweepBorrower::Take() {
  {
    const MutexLock lock(mutex_);
    asking_ = true;
  }
  store_.TakeLoan(worker_, [this](const absl::StatusOr<std::optional<Loan>>& loan) {
    if (loan.ok() && *loan) return Fetch(**loan);
    Forget();
  });
}

void SweepBorrower::Fetch(const Loan& loan) {
  {
    const MutexLock lock(mutex_);
    loan_ = loan;
  }
  store_.Read(loan.job, JobPart::kSpec, [this, loan](absl::StatusOr<StoredJob> stored) {
    if (!stored.ok()) return Forget();
    {
      const MutexLock lock(mutex_);
      fetched_ = {loan, std::move(stored->job)};
      asking_ = false;
    }
    wake_();
  });
}

void SweepBorrower::Forget() {
  const MutexLock lock(mutex_);
  asking_ = false;
  loan_.reset();
}

void SweepBorrower::Begin(const Loan& loan, const v1::Job& job) {
  DecodedSweep plan = DecodeSweep(job.sweep(), options_.scenario_limits);
  const std::int32_t cells = plan.violations.empty() ? plan.axes.cells() : 0;
  if (loan.first < 0 || loan.last >= cells || loan.first > loan.last) return Refuse(loan);
  work_ = std::make_shared<Work>();
  work_->loan = loan;
  const auto store = [weak = std::weak_ptr(work_), wake = wake_](SolvedCell solved) {
    const auto work = weak.lock();
    if (!work) return;
    const MutexLock lock(work->mutex);
    work->solved.push_back(std::move(solved));
    const auto of_loan = static_cast<std::size_t>(work->loan.last - work->loan.first + 1);
    if (work->solved.size() == of_loan) wake();
  };
  work_->run = std::make_shared<SweepRun>(job.sweep(), std::move(plan), AllBut(loan, cells), clock_,
                                          options_, std::make_shared<RunControl>(),
                                          SweepRun::Sink{store, [] {}});
  scheduler_.Help(work_->run);
}

void SweepBorrower::Return() {
  const std::shared_ptr<Work> work = std::exchange(work_, nullptr);
  LoanCounts counts{.steps = work->run->control()->signs()};
  std::vector<v1::Event> events;
  {
    const MutexLock lock(work->mutex);
    std::ranges::sort(work->solved, {}, [](const SolvedCell& s) { return s.cell.index(); });
    for (SolvedCell& solved : work->solved) {
      Count(solved.cell, &counts);
      std::ranges::move(ToEvents(std::move(solved), clock_.Now()), std::back_inserter(events));
    }
  }
  {
    const MutexLock lock(mutex_);
    asking_ = true;
  }
  store_.ReturnLoan(worker_, work->loan, counts, events,
                    [this](const absl::StatusOr<std::uint64_t>& stored) {
                      if (!stored.ok()) spdlog::info("loan: {}", stored.status().ToString());
                      loans_wait_ = true;
                      Forget();
                      wake_();
                    });
}

void SweepBorrower::Refuse(const Loan& loan) {
  if (work_) work_->run->control()->Stop();
  work_ = nullptr;
  {
    const MutexLock lock(mutex_);
    asking_ = true;
  }
  store_.RefuseLoan(worker_, loan, [this](const absl::StatusOr<bool>& /*refused*/) { Forget(); });
}

void SweepBorrower::Stop() {
  if (work_) Refuse(work_->loan);
}

}  // namespace contact
