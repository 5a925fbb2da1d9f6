#include "jobs/schedule/scheduler.h"

#include <fmt/format.h>
#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>
#include <utility>

#include "jobs/job/lifecycle.h"
#include "storage/job_queries.h"
#include "version.h"

namespace contact {
namespace {

// After so long a helper looks whether a job has come that needs a worker.
constexpr std::chrono::milliseconds kHelpTime{10};
// Specs of waiting jobs that are kept in memory, so that their workers need not wait for the store.
constexpr std::size_t kMostSpecBytes = 16 << 20;
// What the runs have to end in when the server does.
constexpr std::chrono::seconds kEndTime{2};

Transition TransitionAfterCrash(const StoredJob& stored, int max_attempts) {
  if (stored.cancel_requested) return {v1::Job::CANCELLED, reason::kUserRequest};
  if (stored.job.attempt() < max_attempts) return {v1::Job::QUEUED, reason::kServerRestarted};
  return {v1::Job::FAILED, reason::kCrashed,
          fmt::format("the server died during attempt {} of {}; the job is set aside",
                      stored.job.attempt(), max_attempts),
          absl::StatusCode::kAborted};
}

}  // namespace

Scheduler::Scheduler(Store& store, const Clock& clock, const JobOptions& options, JobFeed& feed)
    : store_(store),
      clock_(clock),
      options_(options),
      feed_(feed),
      workers_([this](Worker& worker) { Work(worker); }) {
  Recover();
  workers_.Start(options_.workers);
  watch_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "watchdog");
    Watch();
  });
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

// A job that was running has lost its worker.
void Scheduler::Recover(StoredJob stored) {
  if (!stored.intact) spdlog::error("job={} fails its checksum in the store", stored.job.name());
  const Transition transition = TransitionAfterCrash(stored, options_.max_attempts);
  Active active;
  active.log = NewLog(stored.job.name(), stored.job.last_sequence());
  active.epoch = stored.epoch;
  v1::Job& job = active.job = std::move(stored.job);
  if (job.state() == v1::Job::RUNNING) {
    const std::vector<v1::Event> events = {Apply(transition, clock_.Now(), &job)};
    options_.metrics->Moved(v1::Job::RUNNING, job);
    store_.Update({.name = job.name(), .epoch = active.epoch, .job = &job, .events = events},
                  [log = active.log, events](const absl::StatusOr<std::uint64_t>& first) {
                    if (first.ok()) log->Append(*first, events);
                  });
  }
  const MutexLock lock(mutex_);
  if (!IsFinal(job.state())) Add(std::move(active));
}

void Scheduler::Add(Active active) {
  active.number = ++numbers_;
  Queue(active);
  std::string name = active.job.name();
  active_.emplace(std::move(name), std::move(active));
}

void Scheduler::Queue(const Active& active) {
  const v1::Job& job = active.job;
  queue_.Push({job.name(), job.priority(), active.number, LastAttempt(job)});
  changed_.notify_one();
}

// True if it has been running when the server died, and may be only once more.
bool Scheduler::LastAttempt(const v1::Job& job) const {
  return job.attempt() > 0 && job.attempt() + 1 >= options_.max_attempts;
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
  KeepSpec(&active);
  Add(std::move(active));
}

// Takes the spec out of the job, and keeps it if there is room.
void Scheduler::KeepSpec(Active* active) {
  v1::Job& job = active->job;
  if (const std::size_t bytes = job.ByteSizeLong(); spec_bytes_ + bytes <= kMostSpecBytes) {
    spec_bytes_ += bytes;
    active->spec = std::make_shared<const StoredJob>(StoredJob{.job = job});
  }
  job.clear_spec();
}

std::shared_ptr<const StoredJob> Scheduler::TakeSpec(Active* active) {
  if (active->spec) spec_bytes_ -= active->spec->job.ByteSizeLong();
  return std::exchange(active->spec, nullptr);
}

void Scheduler::Work(Worker& worker) {
  JobRunner runner(store_, clock_, options_, endings_, shutdown_.get_token());
  for (Task task = Next(worker); task.job || task.sweep; task = Next(worker)) {
    if (task.sweep) {
      task.sweep->Work(kHelpTime);
    } else {
      const std::string name = task.job->job.name();
      runner.Run(*std::move(task.job), [this, name] { Remove(name); });
    }
    if (!worker.End()) return;  // This may not exist any more.
  }
}

// Waits for something to do.
Scheduler::Task Scheduler::Next(Worker& worker) {
  const MutexLock lock(mutex_);
  for (;;) {
    if (shutdown_.stop_requested()) return {};
    if (const auto name = NextJob()) {
      Task task{Assign(active_.at(*name)), nullptr};
      worker.Begin(task.job->control);
      return task;
    }
    if (auto sweep = FindSweep()) {
      worker.Begin(sweep->control());
      return {std::nullopt, std::move(sweep)};
    }
    changed_.wait(mutex_);
  }
}

std::optional<std::string> Scheduler::NextJob() {
  const bool careful =
      std::ranges::any_of(running_, [](const auto& job) { return job.second.last_attempt; });
  const auto next = queue_.Pop(careful);
  return next ? std::optional(next->name) : std::nullopt;
}

Assignment Scheduler::Assign(Active& active) {
  if (running_.empty()) started_.notify_one();
  running_.emplace(active.job.name(), Running{Watchdog(clock_.Elapsed()), LastAttempt(active.job)});
  active.control = std::make_shared<RunControl>(BudgetOf(active.job, options_.max_budget));
  active.job.set_attempt(active.job.attempt() + 1);
  v1::Event event = Apply({v1::Job::RUNNING}, clock_.Now(), &active.job);
  options_.metrics->Moved(v1::Job::QUEUED, active.job);
  return {active.job,       TakeSpec(&active),
          std::move(event), active.epoch,
          active.log,       active.record,
          active.control,   [this](std::shared_ptr<SweepRun> sweep) { Offer(std::move(sweep)); }};
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
  running_.erase(name);
  changed_.notify_all();  // A last attempt may have waited for this.
}

void Scheduler::Cancel(const std::string& name, const std::string& expected_uid, Done done) {
  bool running = false;
  std::optional<Active> queued;
  std::optional<v1::Job> other;
  {
    const MutexLock lock(mutex_);
    const auto found = active_.find(name);
    if (found != active_.end() && !expected_uid.empty() &&
        found->second.job.uid() != expected_uid) {
      other = found->second.job;
    } else if (found != active_.end() && found->second.control) {
      running = true;
      found->second.control->Stop(StopCause::kUser);
    } else if (found != active_.end() &&
               queue_.Remove(found->second.job.priority(), found->second.number)) {
      TakeSpec(&found->second);
      queued = found->second;  // From here on no worker finds it.
    }
  }
  if (other) return done(OtherJob(*other));
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
                [this, events, job, active,
                 done = std::move(done)](const absl::StatusOr<std::uint64_t>& first) {
                  if (first.ok()) {
                    options_.metrics->Moved(v1::Job::QUEUED, job);
                    active.log->Append(*first, events);
                  }
                  {
                    const MutexLock lock(mutex_);
                    if (first.ok()) {
                      active_.erase(active.job.name());
                    } else {
                      Queue(active);
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

std::shared_ptr<const RunRecord> Scheduler::Record(const v1::Job& job) const {
  if (job.state() != v1::Job::RUNNING) return nullptr;
  const MutexLock lock(mutex_);
  const auto found = active_.find(job.name());
  return found == active_.end() ? nullptr : found->second.record;
}

int Scheduler::queued() const {
  const MutexLock lock(mutex_);
  return static_cast<int>(queue_.size());
}

int Scheduler::running() const {
  const MutexLock lock(mutex_);
  return static_cast<int>(running_.size());
}

void Scheduler::Watch() {
  while (!shutdown_.stop_requested()) {
    std::vector<Active> lost;
    {
      const MutexLock lock(mutex_);
      if (shutdown_.stop_requested()) return;
      if (running_.empty()) {
        started_.wait(mutex_);
      } else {
        started_.wait_for(mutex_, options_.look_interval);
      }
      lost = FindLost();
    }
    for (const Active& active : lost) FailLostRun(active);
    endings_.Retry();
  }
}

// Gives up the runs that do not hear, and has their workers replaced.
std::vector<Scheduler::Active> Scheduler::FindLost() {
  std::vector<Active> lost;
  const Watchdog::Patience patience{options_.step_timeout, options_.stop_timeout};
  for (auto& [name, running] : running_) {
    const Active& active = active_.at(name);
    if (!running.watchdog.Look(*active.control, clock_.Elapsed(), patience)) continue;
    if (!active.control->GiveUp()) continue;
    workers_.Replace(*active.control);
    lost.push_back(active);
  }
  for (const Active& active : lost) running_.erase(active.job.name());
  return lost;
}

// Ends a job whose run was given up, and takes it away from its worker in the store too.
void Scheduler::FailLostRun(const Active& active) {
  store_.Read(
      active.job.name(), JobPart::kHeader, [this, active](absl::StatusOr<StoredJob> stored) {
        if (!stored.ok() || IsFinal(stored->job.state())) return;
        v1::Job job = active.job;
        job.MergeFrom(active.record->Get(true));
        job.set_server_version(kVersion);
        const Transition transition =
            TransitionAfterStop(active.control->cause(), active.control->budget());
        const std::vector<v1::Event> events = {Apply(transition, clock_.Now(), &job)};
        store_.Update({.name = job.name(),
                       .epoch = stored->epoch,
                       .take = true,
                       .job = &job,
                       .events = events},
                      [this, events, active, job](const absl::StatusOr<std::uint64_t>& first) {
                        if (!first.ok()) {
                          return spdlog::error("job={} cannot store its end: {}", active.job.name(),
                                               first.status().ToString());
                        }
                        options_.metrics->Moved(v1::Job::RUNNING, job);
                        active.log->Append(*first, events);
                        Remove(active.job.name());
                      });
      });
}

void Scheduler::Stop() {
  {
    const MutexLock lock(mutex_);
    shutdown_.request_stop();
    for (auto& [name, active] : active_) {
      if (active.control) active.control->Stop();
    }
    changed_.notify_all();
    started_.notify_all();
  }
  if (watch_.joinable()) watch_.join();
  workers_.Stop(kEndTime);
}

}  // namespace contact
