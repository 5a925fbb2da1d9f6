#include "jobs/cluster/shared_jobs.h"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "base/future.h"
#include "jobs/job/lifecycle.h"
#include "storage/refusals.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

// How often the store is asked for what notes should have told.
constexpr auto kAskTime = 1s;
// After so many looks at logs of which notes tell, everything is asked again, however many notes
// come. A process tells of a log twenty times a second at most.
constexpr int kMostLooks = 20;
// Workers tell how far their runs are every few seconds, also if nothing has changed.
constexpr auto kForgetTime = 15s;

}  // namespace

SharedJobs::SharedJobs(SharedStore& store, const Clock& clock, const JobOptions& options,
                       const SharedOptions& shared, JobFeed& feed)
    : store_(store), clock_(clock), options_(options), feed_(feed) {
  if (shared.works) {
    claimer_ = std::make_unique<JobClaimer>(store, clock, options, shared, feed);
  }
  store_.Listen([this](const Note& note) { Hear(note); },
                [this] {
                  const MutexLock lock(mutex_);
                  to_ask_ = true;
                  missed_.notify_all();
                });
  thread_ = std::jthread([this](const std::stop_token& stop) { Follow(stop); });
}

SharedJobs::~SharedJobs() { Stop(); }

void SharedJobs::Hear(const Note& note) {
  switch (note.kind) {
    case Note::Kind::kChanged: {
      if (logs_.Has(note.name)) {
        const MutexLock lock(mutex_);
        moved_logs_.insert(note.name);
        missed_.notify_all();
      }
      if (note.state == 0) return;
      feed_.Changed(note.tenant, note.name);
      if (claimer_ && note.state == v1::Job::QUEUED) claimer_->JobsWait();
      return;
    }
    case Note::Kind::kCancel:
      if (claimer_) claimer_->LookForCancel(note.name);
      return;
    case Note::Kind::kLoans:
      if (claimer_) claimer_->LoansWait();
      return;
    case Note::Kind::kProgress:
      return HearProgress(note);
  }
}

void SharedJobs::HearProgress(const Note& note) {
  v1::Event event = EventAt(clock_.Now());
  if (!event.mutable_progress()->ParseFromString(note.progress)) return;
  logs_.SetProgress(note.name, event);
  const MutexLock lock(mutex_);
  Told& told = told_[note.name];
  told.time = clock_.Elapsed();
  told.record->Do([&event](v1::Job& job) { *job.mutable_progress() = event.progress(); });
}

void SharedJobs::Follow(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "follower");
  while (!stop.stop_requested()) {
    Ask();
    for (int rest = kMostLooks; rest > 0; --rest) {
      const std::set<std::string> names = AwaitMovedLogs(stop);
      if (names.empty()) break;
      AskPositions({names.begin(), names.end()});
    }
  }
}

std::set<std::string> SharedJobs::AwaitMovedLogs(const std::stop_token& stop) {
  const MutexLock lock(mutex_);
  missed_.wait_for(mutex_, stop, kAskTime, [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    return to_ask_ || !moved_logs_.empty();
  });
  if (std::exchange(to_ask_, false)) return {};
  return std::exchange(moved_logs_, {});
}

void SharedJobs::Ask() {
  if (!AskMoved()) return;  // The next time tells.
  AskPositions(logs_.names());
  const auto demand =
      Await<absl::StatusOr<Demand>>([this](auto done) { store_.Count(std::move(done)); });
  if (demand.ok()) {
    const MutexLock lock(mutex_);
    demand_ = *demand;
  }
  if (claimer_ && demand.ok()) {
    claimer_->SetDemand(*demand);
    if (demand->queued > 0) claimer_->JobsWait();
  }
  ForgetOld();
}

// Where nobody watches, only where to begin is asked for.
bool SharedJobs::AskMoved() {
  const bool watched = feed_.watched();
  const auto moved = Await<absl::StatusOr<MovedJobs>>(
      [&](auto done) { store_.Moved(watched ? moved_ : 0, std::move(done)); });
  if (!moved.ok()) return false;
  for (const MovedJobs::Job& job : moved->jobs) feed_.Changed(job.tenant, job.name);
  // Somebody who has begun meanwhile may have looked before.
  if (watched || moved_ == 0 || !feed_.watched()) moved_ = moved->next;
  return true;
}

void SharedJobs::AskPositions(const std::vector<std::string>& names) {
  if (names.empty()) return;
  const auto positions = Await<absl::StatusOr<std::vector<LogPosition>>>(
      [&](auto done) { store_.Positions(names, std::move(done)); });
  if (!positions.ok()) return;
  for (const LogPosition& position : *positions) logs_.Advance(position);
}

void SharedJobs::ForgetOld() {
  const auto now = clock_.Elapsed();
  const MutexLock lock(mutex_);
  std::erase_if(told_, [now](const auto& entry) { return now - entry.second.time > kForgetTime; });
}

std::shared_ptr<JobLog> SharedJobs::Log(const v1::Job& job) {
  if (IsFinal(job.state())) return std::make_shared<JobLog>(job.last_sequence(), true);
  auto log = logs_.Follow(job);
  // What has happened between the reading of the job and here.
  store_.Positions({job.name()}, [this](const absl::StatusOr<std::vector<LogPosition>>& now) {
    if (now.ok() && !now->empty()) logs_.Advance(now->front());
  });
  return log;
}

std::shared_ptr<const RunRecord> SharedJobs::Record(const v1::Job& job) const {
  if (job.state() != v1::Job::RUNNING) return nullptr;
  if (claimer_) {
    if (auto record = claimer_->scheduler().Record(job)) return record;
  }
  const MutexLock lock(mutex_);
  const auto found = told_.find(job.name());
  return found == told_.end() ? nullptr : found->second.record;
}

Demand SharedJobs::demand() const {
  const MutexLock lock(mutex_);
  Demand demand = demand_;
  // The first heartbeat may not have come yet.
  if (claimer_) demand.threads = std::max<std::int64_t>(demand.threads, options_.workers);
  return demand;
}

void SharedJobs::CountOf(const JobOwner& whose,
                         std::function<void(absl::StatusOr<OwnerCounts>)> done) {
  store_.CountOf(whose, std::move(done));
}

void SharedJobs::Cancel(const std::string& name, const std::string& expected_uid, Done done) {
  store_.Read(
      name, JobPart::kHeader,
      [this, name, expected_uid, done = std::move(done)](absl::StatusOr<StoredJob> stored) mutable {
        if (!stored.ok()) return done(stored.status());
        if (!expected_uid.empty() && stored->job.uid() != expected_uid) {
          return done(OtherJob(stored->job));
        }
        if (IsFinal(stored->job.state())) return done(absl::OkStatus());
        store_.RequestCancel(name, [this, stored = *std::move(stored), done = std::move(done)](
                                       const absl::StatusOr<bool>& asked) mutable {
          if (!asked.ok() || stored.job.state() == v1::Job::RUNNING) return done(asked.status());
          Withdraw(std::move(stored), done);
        });
      });
}

void SharedJobs::Withdraw(StoredJob stored, const Done& done) {
  v1::Job job = std::move(stored.job);
  const std::string name = job.name();
  const std::vector<v1::Event> events = {
      Apply({v1::Job::CANCELLED, reason::kUserRequest}, clock_.Now(), &job)};
  store_.Update({.name = name, .epoch = stored.epoch, .take = true, .job = &job, .events = events},
                [this, job, done](const absl::StatusOr<std::uint64_t>& first) {
                  if (first.ok()) options_.metrics->Moved(v1::Job::QUEUED, job);
                  // A worker has the job now: it finds that it is to be cancelled.
                  done(absl::IsAborted(first.status()) ? absl::OkStatus() : first.status());
                });
}

void SharedJobs::Stop() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  if (claimer_) claimer_->Stop();
  store_.Unlisten();
  Await<bool>([this](const auto& done) { store_.Flush([done] { done(true); }); });
}

}  // namespace contact
