#include "jobs/schedule/scheduler.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "base/future.h"
#include "jobs/job/lifecycle.h"
#include "storage/job_parts.h"
#include "storage/refusals.h"
#include "version.h"

namespace contact {
namespace {

// After so long a helper looks whether a job has come that needs a worker.
constexpr std::chrono::milliseconds kHelpTime{10};
// A helper in a long cell leaves it when a job has waited for so long [s].
constexpr double kLeaveTime = 0.5;
// How often it looks for that [s].
constexpr double kLookTime = 0.01;
// What the runs have to end in when the server does.
constexpr std::chrono::seconds kEndTime{2};

Transition TransitionAfterCrash(const v1::Job& job, bool cancel_requested, int max_attempts) {
  if (cancel_requested) return {v1::Job::CANCELLED, reason::kUserRequest};
  if (job.attempt() < max_attempts) return {v1::Job::QUEUED, reason::kServerRestarted};
  return {v1::Job::FAILED, reason::kCrashed,
          fmt::format("the server died during attempt {} of {}; the job is set aside",
                      job.attempt(), max_attempts),
          absl::StatusCode::kAborted};
}

// What an unfinished job of an earlier start takes of its owner's limits.
std::shared_ptr<const void> Hold(Quotas* quotas, const v1::Job& job) {
  const JobOwner whose{OwnerOf(job), TenantOf(job)};
  auto place = quotas->Keep(whose, v1::Quota::UNFINISHED_JOBS);
  if (job.progress().cells() == 0) return place;
  return Quotas::Both(std::move(place),
                      quotas->Keep(whose, v1::Quota::CELLS, job.progress().cells()));
}

// True if the job was running when the server died, and may be run only once more.
bool IsLastAttempt(const v1::Job& job, int max_attempts) {
  return job.attempt() > 0 && job.attempt() + 1 >= max_attempts;
}

}  // namespace

Scheduler::Scheduler(Store& store, const Clock& clock, const JobOptions& options, JobFeed& feed,
                     Quotas& quotas, std::function<void()> left)
    : store_(store),
      clock_(clock),
      options_(options),
      feed_(feed),
      quotas_(quotas),
      left_(std::move(left)),
      turns_(options.workers, options.max_running_per_owner),
      memory_(options.resident, options.max_budget.memory_bytes * options.workers),
      workers_([this](Worker& worker) { Work(worker); }),
      supervisor_(
          clock, options, endings_,
          [this](const std::string& job, const RunControl& run) { FailLostRun(job, run); },
          [this] { Balance(); }) {}

void Scheduler::Start() {
  {
    const MutexLock lock(mutex_);
    idle_ = options_.workers;
  }
  workers_.Start(options_.workers);
}

double Scheduler::Now() const {
  return std::chrono::duration<double>(clock_.Elapsed().time_since_epoch()).count();
}

Scheduler::~Scheduler() { Stop(); }

std::shared_ptr<JobLog> Scheduler::NewLog(const v1::Job& job, std::uint64_t last) {
  return std::make_shared<JobLog>(
      last, false,
      [this, tenant = TenantOf(job), name = job.name()] { feed_.Changed(tenant, name); },
      [this, name = job.name()] { FreeQuota(name); });
}

void Scheduler::Recover() {
  auto jobs = Await<absl::StatusOr<std::vector<StoredJob>>>(
      [this](auto done) { store_.ListUnfinished(std::move(done)); });
  if (!jobs.ok()) {
    return spdlog::error("cannot find the unfinished jobs: {}", jobs.status().ToString());
  }
  for (StoredJob& stored : *jobs) {
    const bool cancel_requested = stored.cancel_requested;
    Active active = ToActive(std::move(stored));
    if (active.job.state() == v1::Job::RUNNING) active.job = Settle(active, cancel_requested);
    if (IsFinal(active.job.state())) continue;
    active.held = Hold(&quotas_, active.job);
    const MutexLock lock(mutex_);
    Add(std::move(active));
  }
  Await<bool>([this](const auto& done) { store_.Flush([done] { done(true); }); });
}

Scheduler::Active Scheduler::ToActive(StoredJob stored) {
  if (!stored.intact) spdlog::error("job={} fails its checksum in the store", stored.job.name());
  Active active;
  active.log = NewLog(stored.job, stored.job.last_sequence());
  active.epoch = stored.epoch;
  active.job = std::move(stored.job);
  return active;
}

v1::Job Scheduler::Settle(const Active& active, bool cancel_requested) {
  return Commit(active, TransitionAfterCrash(active.job, cancel_requested, options_.max_attempts),
                false, [](const absl::Status& /*stored*/) {});
}

void Scheduler::Settle(StoredJob stored) {
  const bool cancel_requested = stored.cancel_requested;
  Settle(ToActive(std::move(stored)), cancel_requested);
}

void Scheduler::Take(StoredJob stored) {
  const MutexLock lock(mutex_);
  if (active_.contains(stored.job.name())) return;
  specs_.Keep(&stored);
  Add(ToActive(std::move(stored)));
}

void Scheduler::Lose(const std::string& name) {
  {
    const MutexLock lock(mutex_);
    const auto found = active_.find(name);
    if (found == active_.end()) return;
    spdlog::warn("job={} has another worker", name);
    Active& active = found->second;
    active.lost = true;
    if (active.control) active.control->Stop();
    if (active.control ? !active.unstored : !turns_.Remove(TurnOf(active))) return;
  }
  Remove(name);
}

bool Scheduler::IsToEnd(const std::string& name) {
  const MutexLock lock(mutex_);
  const auto found = active_.find(name);
  if (found == active_.end()) return false;
  found->second.unstored = true;
  return !found->second.lost;
}

v1::Job Scheduler::Commit(Active active, const Transition& transition, bool take, Done stored) {
  v1::Job& job = active.job;
  const v1::Job::State from = job.state();
  const std::vector<v1::Event> events = {Apply(transition, clock_.Now(), &job)};
  store_.Update(
      {.name = job.name(), .epoch = active.epoch, .take = take, .job = &job, .events = events},
      [this, from, events, job, log = active.log,
       stored = std::move(stored)](const absl::StatusOr<std::uint64_t>& first) {
        if (first.ok()) {
          options_.metrics->Moved(from, job);
          log->Append(*first, events);
        }
        stored(first.status());
      });
  return std::move(job);
}

void Scheduler::Add(Active active) {
  active.number = ++numbers_;
  Queue(active);
  std::string name = active.job.name();
  active_.emplace(std::move(name), std::move(active));
}

Turns::Job Scheduler::TurnOf(const Active& active) const {
  const v1::Job& job = active.job;
  return {.share = {TenantOf(job), OwnerOf(job)},
          .name = job.name(),
          .priority = job.priority(),
          .number = active.number,
          .last_attempt = IsLastAttempt(job, options_.max_attempts)};
}

void Scheduler::Queue(const Active& active) {
  turns_.Add(TurnOf(active));
  changed_.notify_all();
}

bool Scheduler::Reserve(int most) {
  const MutexLock lock(mutex_);
  if (turns_.waiting() + reserved_ >= most) return false;
  ++reserved_;
  return true;
}

void Scheduler::Release() {
  const MutexLock lock(mutex_);
  --reserved_;
}

void Scheduler::Enqueue(v1::Job job, std::vector<v1::Event> events,
                        std::shared_ptr<const void> held) {
  StoredJob stored{.job = std::move(job)};
  Active active;
  active.held = std::move(held);
  active.log = NewLog(stored.job, 0);
  active.log->Append(1, std::move(events));
  const MutexLock lock(mutex_);
  --reserved_;
  specs_.Keep(&stored);
  active.job = std::move(stored.job);
  Add(std::move(active));
}

void Scheduler::Work(Worker& worker) {
  JobRunner runner(store_, clock_, options_, endings_, shutdown_.get_token());
  for (Task task = Next(worker); task.job || task.sweep; task = Next(worker)) {
    if (task.sweep) {
      task.sweep->Work(kHelpTime, [this, look = Look()]() mutable { return IsWanted(&look); });
    } else {
      runner.Run(*std::move(task.job), [this, name = task.name](bool stored) {
        if (stored || !IsToEnd(name)) Remove(name);
      });
    }
    if (!worker.End()) return;  // This may not exist any more.
    const MutexLock lock(mutex_);
    EndTask(task);
  }
}

Scheduler::Task Scheduler::Next(Worker& worker) {
  const MutexLock lock(mutex_);
  for (;;) {
    if (shutdown_.stop_requested()) return {};
    if (memory_.crowded() && !turns_.idle()) {
      changed_.wait(mutex_);
      continue;
    }
    if (const auto next = turns_.Take(careful(), Now())) {
      if (next->parked) {  // Its thread goes on.
        changed_.notify_all();
        continue;
      }
      --idle_;
      Task task{Assign(active_.at(next->name)), nullptr, next->name};
      worker.Begin(task.job->control);
      return task;
    }
    if (auto sweep = sweeps_.Find(); sweep && turns_.Borrow()) {
      --idle_;
      worker.Begin(sweep->control());
      return {std::nullopt, std::move(sweep)};
    }
    changed_.wait(mutex_);
  }
}

void Scheduler::EndTask(const Task& task) {
  ++idle_;
  if (const auto ended = active_.find(task.name); ended != active_.end()) {
    ended->second.ending = true;
  }
  // A run that was given up may have been ended for it.
  if (task.sweep || !turns_.End(task.name, Now())) turns_.GiveBack();
}

bool Scheduler::IsWanted(Look* look) const {
  const double now = Now();
  if (now - look->last < kLookTime) return false;
  look->last = now;
  const MutexLock lock(mutex_);
  if (!turns_.ready(careful())) {
    look->since.reset();
  } else if (!look->since) {
    look->since = now;
  }
  return look->since && now - *look->since > kLeaveTime;
}

bool Scheduler::careful() const {
  return std::ranges::any_of(running_, [](const auto& job) { return job.second; });
}

void Scheduler::Balance() {
  const MutexLock lock(mutex_);
  const bool was_crowded = memory_.crowded();
  if (memory_.Look()) return;  // Whoever yields keeps its memory.
  if (was_crowded) changed_.notify_all();
  const auto name = turns_.ToYield(careful(), Now());
  if (!name) return;
  if (const auto found = active_.find(*name); found != active_.end()) {
    found->second.control->AskToYield();
  }
}

void Scheduler::Yield(const std::string& name, RunControl& control) {
  const RunControl::Hold hold(control);
  if (!hold) return;
  const MutexLock lock(mutex_);
  control.SetWaiting(true);
  turns_.Park(name, Now());
  if (idle_ == 0) {
    ++idle_;
    workers_.Start(1);
  }
  changed_.notify_all();
  changed_.wait(mutex_, control.token(), [this, &name]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return !turns_.parked(name);
  });
  if (turns_.parked(name)) turns_.Unpark(name, Now());
  control.SetWaiting(false);
}

Assignment Scheduler::Assign(Active& active) {
  v1::Job& job = active.job;
  active.control = std::make_shared<RunControl>(BudgetOf(job, options_.max_budget));
  running_.emplace(job.name(), IsLastAttempt(job, options_.max_attempts));
  supervisor_.Add(job.name(), active.control);
  job.set_attempt(job.attempt() + 1);
  v1::Event event = Apply({v1::Job::RUNNING}, clock_.Now(), &job);
  options_.metrics->Moved(v1::Job::QUEUED, job);
  return {job,
          specs_.Take(job.name()),
          std::move(event),
          active.epoch,
          active.log,
          active.record,
          active.control,
          [this, name = job.name()](const std::shared_ptr<SweepRun>& sweep) {
            {
              const MutexLock lock(mutex_);
              if (const auto found = active_.find(name); found != active_.end()) {
                found->second.sweep = sweep;
              }
            }
            Offer(sweep);
          },
          [this, name = job.name(), control = active.control] { Yield(name, *control); }};
}

void Scheduler::Offer(const std::shared_ptr<SweepRun>& sweep) {
  const MutexLock lock(mutex_);
  sweeps_.Add(sweep);
  changed_.notify_all();
}

void Scheduler::Remove(const std::string& name) {
  supervisor_.Remove(name);
  FreeQuota(name);
  const MutexLock lock(mutex_);
  active_.erase(name);
  running_.erase(name);
  specs_.Take(name);
  changed_.notify_all();  // A last attempt may have waited for this.
  left_();
}

void Scheduler::FreeQuota(const std::string& name) {
  std::shared_ptr<const void> held;  // Goes after the lock.
  const MutexLock lock(mutex_);
  if (const auto found = active_.find(name); found != active_.end()) {
    held = std::exchange(found->second.held, nullptr);
  }
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
    } else if (found != active_.end() && turns_.Remove(TurnOf(found->second))) {
      specs_.Take(name);
      queued = found->second;  // From here on no worker finds it.
      queued->held = nullptr;  // The entry in active_ holds it.
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
  Commit(active, {v1::Job::CANCELLED, reason::kUserRequest}, false,
         [this, active = active, done = std::move(done)](const absl::Status& stored) {
           // ABORTED: it has ended by a call whose answer was lost, or another worker has it.
           const bool gone = stored.ok() || absl::IsAborted(stored);
           if (gone) FreeQuota(active.job.name());
           {
             const MutexLock lock(mutex_);
             if (gone) {
               active_.erase(active.job.name());
             } else {
               Queue(active);
             }
           }
           done(stored);
         });
}

std::shared_ptr<JobLog> Scheduler::Log(const v1::Job& job) {
  const MutexLock lock(mutex_);
  const auto found = active_.find(job.name());
  if (found != active_.end()) return found->second.log;
  return std::make_shared<JobLog>(job.last_sequence(), true);
}

std::shared_ptr<const RunRecord> Scheduler::Record(const v1::Job& job) const {
  if (job.state() != v1::Job::RUNNING) return nullptr;
  const MutexLock lock(mutex_);
  const auto found = active_.find(job.name());
  return found == active_.end() ? nullptr : found->second.record;
}

Demand Scheduler::demand() const {
  const MutexLock lock(mutex_);
  return {.queued = turns_.waiting(),
          .running = static_cast<std::int64_t>(running_.size()),
          .workers = 1,
          .threads = options_.workers};
}

std::vector<Scheduler::Here> Scheduler::jobs() const {
  const MutexLock lock(mutex_);
  std::vector<Here> jobs;
  for (const auto& [name, active] : active_) {
    jobs.push_back({.name = name,
                    .whose = {OwnerOf(active.job), TenantOf(active.job)},
                    .running = running_.contains(name) && !active.ending,
                    .ending = active.ending,
                    .progress = active.record->Get(false).progress()});
  }
  return jobs;
}

std::vector<Scheduler::OwnSweep> Scheduler::sweeps() const {
  const MutexLock lock(mutex_);
  std::vector<OwnSweep> sweeps;
  for (const auto& [name, active] : active_) {
    if (auto run = active.sweep.lock()) sweeps.push_back({name, std::move(run)});
  }
  return sweeps;
}

int Scheduler::idle() const {
  const MutexLock lock(mutex_);
  return idle_ - turns_.waiting();
}

void Scheduler::CountOf(const JobOwner& whose,
                        std::function<void(absl::StatusOr<OwnerCounts>)> done) {
  OwnerCounts counts{.jobs = quotas_.used(whose, v1::Quota::UNFINISHED_JOBS),
                     .cells = quotas_.used(whose, v1::Quota::CELLS)};
  {
    const MutexLock lock(mutex_);
    for (const auto& [name, last_attempt] : running_) {
      const auto found = active_.find(name);
      if (found == active_.end()) continue;
      const v1::Job& job = found->second.job;
      counts.running += OwnerOf(job) == whose.owner && TenantOf(job) == whose.tenant ? 1 : 0;
    }
  }
  done(counts);
}

void Scheduler::FailLostRun(const std::string& name, const RunControl& run) {
  const int lost = workers_.Replace(run);
  Active active;
  {
    const MutexLock lock(mutex_);
    running_.erase(name);
    idle_ += lost;
    const bool ended = lost > 0 && turns_.End(name, Now());
    turns_.GiveBack(ended ? lost - 1 : lost);
    active = active_.at(name);
  }
  store_.Read(name, JobPart::kHeader,
              [this, name, active = std::move(active)](absl::StatusOr<StoredJob> stored) mutable {
                if (!stored.ok() || IsFinal(stored->job.state())) return;
                // The run may have taken the job; past that it is another worker's.
                if (stored->epoch > active.epoch + 1) return Remove(name);
                active.epoch = stored->epoch;
                active.job.MergeFrom(active.record->Get(true));
                active.job.set_server_version(kVersion);
                const RunControl& control = *active.control;
                const Transition failed = TransitionAfterStop(control.cause(), control.budget());
                Commit(std::move(active), failed, true, [this, name](const absl::Status& end) {
                  if (end.ok()) return Remove(name);
                  spdlog::error("job={} cannot store its end: {}", name, end.ToString());
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
  }
  supervisor_.Stop();
  workers_.Stop(kEndTime);
}

}  // namespace contact
