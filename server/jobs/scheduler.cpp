#include "jobs/scheduler.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>
#include <utility>

namespace contact {
namespace {

// After so long a helper looks whether a job has come that needs a worker.
constexpr std::chrono::milliseconds kHelpTime{10};

}  // namespace

Scheduler::Scheduler(Store& store, const Clock& clock, const JobManagerOptions& options,
                     JobFeed& feed)
    : store_(store), clock_(clock), options_(options), feed_(feed) {
  Recover();
  for (int i = 0; i < options_.workers; ++i) workers_.emplace_back([this] { Work(); });
}

Scheduler::~Scheduler() { Stop(); }

std::shared_ptr<JobLog> Scheduler::NewLog(const std::string& name, std::uint64_t last) {
  return std::make_shared<JobLog>(last, false, [this, name] { feed_.Changed(name); });
}

void Scheduler::Recover() {
  std::promise<void> recovered;
  store_.ListUnfinished([this](absl::StatusOr<std::vector<StoredJob>> jobs) {
    if (!jobs.ok()) {
      return spdlog::error("cannot find the unfinished jobs: {}", jobs.status().ToString());
    }
    for (StoredJob& job : *jobs) Recover(std::move(job));
  });
  // Two rounds: the first callback asks for more.
  store_.Flush([&] { store_.Flush([&] { recovered.set_value(); }); });
  recovered.get_future().wait();
}

// A job that was running has lost its worker. One that a user wanted to stop has its wish.
void Scheduler::Recover(StoredJob stored) {
  if (!stored.intact) spdlog::error("{} fails its checksum in the store", stored.job.name());
  Active active;
  active.log = NewLog(stored.job.name(), stored.job.last_sequence());
  active.epoch = stored.epoch;
  v1::Job& job = active.job = std::move(stored.job);
  if (job.state() == v1::Job::RUNNING) {
    const Move move = stored.cancel_requested ? Move{v1::Job::CANCELLED, reason::kUserRequest}
                                              : Move{v1::Job::QUEUED, reason::kServerRestarted};
    const std::vector<v1::Event> events = {Apply(move, clock_.Now(), &job)};
    store_.Update({.name = job.name(), .epoch = active.epoch, .job = &job, .events = events},
                  [log = active.log, events](const absl::StatusOr<std::uint64_t>& first) {
                    if (first.ok()) log->Append(*first, events);
                  });
  }
  const MutexLock lock(mutex_);
  if (!IsFinal(job.state())) Add(std::move(active));
}

void Scheduler::Add(Active active) {
  std::string name = active.job.name();
  queue_.push_back(name);
  active_.emplace(std::move(name), std::move(active));
  changed_.notify_one();
}

bool Scheduler::Reserve() {
  const MutexLock lock(mutex_);
  if (queue_.size() + static_cast<std::size_t>(reserved_) >=
      static_cast<std::size_t>(options_.max_queued_jobs)) {
    return false;
  }
  ++reserved_;
  return true;
}

void Scheduler::Release() {
  const MutexLock lock(mutex_);
  --reserved_;
}

void Scheduler::Enqueue(v1::Job job, std::vector<v1::Event> events) {
  Active active;
  active.job = std::move(job);
  active.log = NewLog(active.job.name(), 0);
  active.log->Append(1, std::move(events));
  const MutexLock lock(mutex_);
  --reserved_;
  Add(std::move(active));
}

void Scheduler::Work() {
  JobRunner runner(store_, clock_, options_, shutdown_.get_token());
  for (Task task = Next(); task.job || task.sweep; task = Next()) {
    if (task.sweep) {
      task.sweep->Work(kHelpTime);
      continue;
    }
    const std::string name = task.job->job.name();
    runner.Run(*std::move(task.job), [this, name] { Remove(name); });
  }
}

// Waits for something to do.
Scheduler::Task Scheduler::Next() {
  const MutexLock lock(mutex_);
  for (;;) {
    if (shutdown_.stop_requested()) return {};
    if (!queue_.empty()) {
      Active& active = active_.at(queue_.front());
      queue_.pop_front();
      return {Assign(active), nullptr};
    }
    if (auto sweep = FindSweep()) return {std::nullopt, std::move(sweep)};
    changed_.wait(mutex_);
  }
}

Assignment Scheduler::Assign(Active& active) {
  ++running_;
  active.job.set_attempt(active.job.attempt() + 1);
  v1::Event event = Apply({v1::Job::RUNNING}, clock_.Now(), &active.job);
  return {active.job,       std::move(event),
          active.epoch,     active.log,
          active.record,    active.stop,
          active.cancelled, [this](std::shared_ptr<SweepRun> sweep) { Offer(std::move(sweep)); }};
}

void Scheduler::Offer(std::shared_ptr<SweepRun> sweep) {
  const MutexLock lock(mutex_);
  sweeps_.push_back(std::move(sweep));
  changed_.notify_all();
}

// The oldest sweep that has a cell to compute.
std::shared_ptr<SweepRun> Scheduler::FindSweep() {
  std::erase_if(sweeps_, [](const auto& sweep) {
    const auto run = sweep.lock();
    return !run || !run->HasWork();
  });
  return sweeps_.empty() ? nullptr : sweeps_.front().lock();
}

void Scheduler::Remove(const std::string& name) {
  const MutexLock lock(mutex_);
  active_.erase(name);
  --running_;
}

void Scheduler::Cancel(const std::string& name, Done done) {
  bool running = false;
  std::optional<Active> queued;
  {
    const MutexLock lock(mutex_);
    const auto found = active_.find(name);
    const auto place = std::find(queue_.begin(), queue_.end(), name);
    if (place != queue_.end()) {
      queue_.erase(place);  // From here on no worker finds it.
      queued = found->second;
    } else if (found != active_.end() && found->second.job.state() == v1::Job::RUNNING) {
      running = true;
      *found->second.cancelled = true;
      found->second.stop.request_stop();
    }
  }
  if (queued) return Withdraw(*queued, std::move(done));
  if (!running) return done(absl::OkStatus());
  store_.RequestCancel(name, [done = std::move(done)](const absl::StatusOr<bool>& stored) {
    done(stored.status());
  });
}

void Scheduler::Withdraw(const Active& active, Done done) {
  v1::Job job = active.job;
  const std::vector<v1::Event> events = {
      Apply({v1::Job::CANCELLED, reason::kUserRequest}, clock_.Now(), &job)};
  store_.Update({.name = job.name(), .epoch = active.epoch, .job = &job, .events = events},
                [this, events, name = job.name(), log = active.log,
                 done = std::move(done)](const absl::StatusOr<std::uint64_t>& first) {
                  if (first.ok()) log->Append(*first, events);
                  {
                    const MutexLock lock(mutex_);
                    if (first.ok()) {
                      active_.erase(name);
                    } else {
                      queue_.push_front(name);
                      changed_.notify_one();
                    }
                  }
                  done(first.status());
                });
}

std::shared_ptr<JobLog> Scheduler::Log(const std::string& name) const {
  const MutexLock lock(mutex_);
  const auto found = active_.find(name);
  return found == active_.end() ? nullptr : found->second.log;
}

void Scheduler::AddRecord(bool with_ledger, v1::Job* job) const {
  if (job->state() != v1::Job::RUNNING) return;
  std::shared_ptr<RunRecord> record;
  {
    const MutexLock lock(mutex_);
    const auto found = active_.find(job->name());
    if (found == active_.end()) return;
    record = found->second.record;
  }
  job->MergeFrom(record->Get(with_ledger));
}

int Scheduler::queued() const {
  const MutexLock lock(mutex_);
  return static_cast<int>(queue_.size());
}

int Scheduler::running() const {
  const MutexLock lock(mutex_);
  return running_;
}

void Scheduler::Stop() {
  {
    const MutexLock lock(mutex_);
    shutdown_.request_stop();
    for (auto& [name, active] : active_) active.stop.request_stop();
    changed_.notify_all();
  }
  for (std::thread& worker : workers_) {
    if (worker.joinable()) worker.join();
  }
}

}  // namespace contact
