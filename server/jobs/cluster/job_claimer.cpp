#include "jobs/cluster/job_claimer.h"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "base/future.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// How often the runs are looked at.
constexpr auto kLookTime = 100ms;
// How often progress is told though it has not changed.
constexpr auto kProgressTime = 5s;
// Beats within a lease: one or two may be lost.
constexpr int kBeats = 5;
// A process whose threads are all busy for so long takes a job of an owner who has none here: the
// scheduler then lets them take turns.
constexpr auto kBusyTime = 1s;
// Jobs claimed ahead of the threads: those that are begun within this time [s], at the pace of
// late.
constexpr double kAheadTime = 0.05;
constexpr int kMostAhead = 64;

WorkerProcess ProcessOf(const SharedOptions& shared, const JobOptions& options) {
  WorkerProcess process = shared.process;
  process.threads = options.workers;
  return process;
}

}  // namespace

JobClaimer::JobClaimer(SharedStore& store, const Clock& clock, const JobOptions& options,
                       const SharedOptions& shared, JobFeed& feed)
    : store_(store),
      clock_(clock),
      options_(options),
      shared_(shared),
      process_(ProcessOf(shared, options)),
      quotas_({}, clock),
      scheduler_(store, clock, options, feed, quotas_, [this] { Left(); }),
      lender_(store, process_.name, options.workers),
      borrower_(store, clock, options, process_.name, scheduler_, [this] { Wake(); }),
      thread_([this](const std::stop_token& stop) {
        scheduler_.Start();
        Loop(stop);
      }) {}

JobClaimer::~JobClaimer() { Stop(); }

void JobClaimer::JobsWait() {
  const MutexLock lock(mutex_);
  jobs_wait_ = true;
  changed_.notify_all();
}

void JobClaimer::LoansWait() {
  borrower_.LoansWait();
  Wake();
}

void JobClaimer::Wake() {
  const MutexLock lock(mutex_);
  woken_ = true;
  changed_.notify_all();
}

void JobClaimer::SetDemand(const Demand& demand) {
  const MutexLock lock(mutex_);
  demand_ = demand;
}

void JobClaimer::Left() {
  const MutexLock lock(mutex_);
  rate_ += 1;
  --enough_;
  woken_ |= !jobs_wait_;  // Threads may be idle now, for cells of sweeps.
  if (woken_ || hungry()) changed_.notify_all();
}

int JobClaimer::IdleElsewhere(const Jobs& jobs) const {
  const MutexLock lock(mutex_);
  const auto running = demand_.running - static_cast<std::int64_t>(jobs.size());
  const std::int64_t idle = demand_.threads - process_.threads - std::max(running, std::int64_t{0});
  return static_cast<int>(std::max(idle, std::int64_t{0}));
}

void JobClaimer::Cancel(const std::string& name) {
  scheduler_.Cancel(name, "", [](const absl::Status& /*stored*/) {});
}

void JobClaimer::LookForCancel(const std::string& name) {
  const Jobs jobs = scheduler_.jobs();
  if (std::ranges::find(jobs, name, &Scheduler::Here::name) == jobs.end()) return;
  store_.Read(name, JobPart::kHeader, [this, name](const absl::StatusOr<StoredJob>& stored) {
    if (stored.ok() && stored->cancel_requested) Cancel(name);
  });
}

void JobClaimer::Loop(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "claimer");
  while (!stop.stop_requested()) {
    const Jobs jobs = scheduler_.jobs();
    const Time now = clock_.Elapsed();
    BeatIfDue(now, jobs);
    ClaimIfUseful(now, jobs);
    borrower_.Look(now);
    Look(now, jobs);
    const MutexLock lock(mutex_);
    changed_.wait_for(mutex_, stop, kLookTime, [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
      return woken_ || hungry();
    });
    woken_ = false;
  }
}

void JobClaimer::BeatIfDue(Time now, const Jobs& jobs) {
  if (now - last_beat_ < process_.lease / kBeats) return;
  {
    const MutexLock lock(mutex_);
    if (std::exchange(beating_, true)) return;
  }
  last_beat_ = now;
  std::set<std::string> had;
  for (const Scheduler::Here& job : jobs) had.insert(job.name);
  store_.Beat(process_, [this, had](const absl::StatusOr<std::vector<HeldJob>>& held) {
    if (held.ok()) Compare(had, *held);
    const MutexLock lock(mutex_);
    beating_ = false;
  });
}

void JobClaimer::Compare(const std::set<std::string>& had, const std::vector<HeldJob>& held) {
  std::set<std::string> lost = had;
  std::set<std::string> here;
  for (const Scheduler::Here& job : scheduler_.jobs()) here.insert(job.name);
  std::set<std::string> strays;
  for (const HeldJob& job : held) {
    lost.erase(job.name);
    if (!here.contains(job.name)) {
      // One that is on its way comes before the next beat.
      if (strays_.contains(job.name)) Adopt(job);
      strays.insert(job.name);
    } else if (job.cancel_requested) {
      Cancel(job.name);
    }
  }
  strays_ = std::move(strays);
  for (const std::string& name : lost) scheduler_.Lose(name);
}

void JobClaimer::Adopt(const HeldJob& held) {
  store_.Read(held.name, JobPart::kHeader,
              [this, epoch = held.epoch](absl::StatusOr<StoredJob> stored) {
                if (stored.ok() && stored->epoch == epoch) TakeIn(*std::move(stored));
              });
}

void JobClaimer::TakeIn(StoredJob stored) {
  if (stored.job.state() == v1::Job::RUNNING || stored.cancel_requested) {
    scheduler_.Settle(std::move(stored));
  } else if (stored.job.state() == v1::Job::QUEUED) {
    scheduler_.Take(std::move(stored));
  }
}

int JobClaimer::Wanted(const Jobs& jobs) {
  const auto here = static_cast<int>(std::ranges::count(jobs, false, &Scheduler::Here::ending));
  const MutexLock lock(mutex_);
  const double per_second = rate_ / 0.144;  // The sum of what halves each tenth of a second.
  const int ahead = std::min(static_cast<int>(per_second * kAheadTime), kMostAhead);
  const int most = options_.workers + ahead - here;
  const int least = std::max(ahead / 2, 1);
  enough_ = std::max(least - most, 0);
  return most < least ? 0 : most;
}

void JobClaimer::ClaimIfUseful(Time now, const Jobs& jobs) {
  const bool busy = std::ranges::count(jobs, true, &Scheduler::Here::running) >= options_.workers;
  if (!busy) busy_since_ = now;
  JobClaim claim{.worker = process_.name,
                 .most = Wanted(jobs),
                 .most_running = options_.max_running_per_owner,
                 .grace = process_.lease};
  if (claim.most == 0) {
    if (now - busy_since_ < kBusyTime) return;
    busy_since_ = now;
    claim.most = 1;
    for (const Scheduler::Here& job : jobs) claim.none_of.push_back(job.whose);
  }
  {
    const MutexLock lock(mutex_);
    const bool due = now - last_claim_ >= process_.lease / kBeats;  // Workers die without a word.
    if (claiming_ || !(jobs_wait_ || due)) return;
    claiming_ = true;
    jobs_wait_ = false;
  }
  last_claim_ = now;
  for (const auto& [whose, time] : std::exchange(used_, {})) {
    claim.used.push_back({{whose.second, whose.first}, time});
  }
  Claim(claim);
}

void JobClaimer::Claim(const JobClaim& claim) {
  const auto most = static_cast<std::size_t>(claim.most);
  store_.Claim(claim, [this, most](absl::StatusOr<std::vector<StoredJob>> claimed) {
    const std::size_t count = claimed.ok() ? claimed->size() : 0;
    if (claimed.ok()) {
      for (StoredJob& stored : *claimed) TakeIn(std::move(stored));
    }
    const MutexLock lock(mutex_);
    claiming_ = false;
    jobs_wait_ |= count >= most;
    changed_.notify_all();
  });
}

void JobClaimer::Look(Time now, const Jobs& jobs) {
  const auto passed = now - last_look_;
  if (passed < kLookTime) return;
  last_look_ = now;
  const auto time =
      std::min(std::chrono::duration_cast<std::chrono::milliseconds>(passed), 2 * kLookTime);
  for (const Scheduler::Here& job : jobs) {
    if (job.running) used_[{job.whose.tenant, job.whose.owner}] += time;
  }
  {
    const MutexLock lock(mutex_);
    rate_ /= 2;
  }
  TellProgress(now, jobs);
  lender_.Look(now, scheduler_.sweeps(), IdleElsewhere(jobs));
  if (!jobs.empty() || borrower_.busy() || last_busy_ == Time()) last_busy_ = now;
  if (shared_.exit_when_idle > 0ms && now - last_busy_ >= shared_.exit_when_idle &&
      !std::exchange(left_, true)) {
    spdlog::info("no job came for the time of --exit-when-idle");
    shared_.leave();
  }
}

void JobClaimer::TellProgress(Time now, const Jobs& jobs) {
  const bool all = now - last_progress_ >= kProgressTime;
  if (all) last_progress_ = now;
  std::map<std::string, std::string> told;
  for (const Scheduler::Here& job : jobs) {
    if (!job.running) continue;
    std::string progress = job.progress.SerializeAsString();
    if (progress.empty()) continue;
    const auto before = told_.find(job.name);
    if (all || before == told_.end() || before->second != progress) {
      store_.Tell({.kind = Note::Kind::kProgress, .name = job.name, .progress = progress});
    }
    told.emplace(job.name, std::move(progress));
  }
  told_ = std::move(told);
}

void JobClaimer::Stop() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
  lender_.TakeBack();
  borrower_.Stop();
  scheduler_.Stop();
  // After what the runs have stored last.
  Await<bool>([this](const auto& done) { store_.Flush([done] { done(true); }); });
  const auto left = Await<absl::StatusOr<bool>>(
      [this](auto done) { store_.Leave(process_.name, std::move(done)); });
  if (!left.ok()) spdlog::warn("cannot take leave of the store: {}", left.status().ToString());
}

}  // namespace contact
