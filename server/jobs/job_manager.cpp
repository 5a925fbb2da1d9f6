#include "jobs/job_manager.h"

#include <fmt/format.h>
#include <google/protobuf/util/time_util.h>

#include <atomic>
#include <future>
#include <utility>

#include "base/clock.h"
#include "base/executor.h"
#include "base/ids.h"
#include "jobs/job/errors.h"
#include "jobs/job/lifecycle.h"
#include "jobs/log/delivery_cursor.h"
#include "jobs/log/job_feed.h"
#include "jobs/log/tail_cursor.h"
#include "jobs/predict.h"
#include "jobs/read/create_rules.h"
#include "jobs/read/list_rules.h"
#include "jobs/read/series_reader.h"
#include "jobs/read/watch_rules.h"
#include "jobs/schedule/retention.h"
#include "jobs/schedule/scheduler.h"
#include "storage/job_queries.h"
#include "storage/store.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/sweep/sweep_codec.h"

namespace contact {
namespace {

// The rules that the scenario or sweep breaks, with paths from the job.
std::vector<Violation> CheckSpec(const v1::Job& job, const ScenarioLimits& limits) {
  std::vector<Violation> violations = job.has_sweep()
                                          ? DecodeSweep(job.sweep(), limits).violations
                                          : DecodeScenario(job.scenario(), limits).violations;
  for (Violation& violation : violations) {
    violation.field = (job.has_sweep() ? "sweep." : "scenario.") + violation.field;
  }
  return violations;
}

void MoveSpec(v1::Job* from, v1::Job* to) {
  if (from->has_sweep()) {
    to->mutable_sweep()->Swap(from->mutable_sweep());
  } else {
    to->mutable_scenario()->Swap(from->mutable_scenario());
  }
}

// How a job is to be treated.
void CopySettings(const v1::Job& from, v1::Job* to) {
  to->set_priority(from.priority());
  if (from.has_budget()) *to->mutable_budget() = from.budget();
  if (from.has_time_to_live()) *to->mutable_time_to_live() = from.time_to_live();
}

// What the store tells of a job that it cannot read.
void DescribeDamage(v1::Job* job) {
  job->mutable_error()->set_code(static_cast<int>(absl::StatusCode::kDataLoss));
  job->mutable_error()->set_message("the stored job fails its checksum");
}

// Leaves out the end of a ledger that would be too large for an answer, and says so.
void ShortenLedger(v1::Job* job) {
  constexpr std::size_t kMostBytes = 2 << 20;
  std::size_t bytes = 0;
  int kept = 0;
  while (kept < job->cycles_size() && bytes < kMostBytes) {
    bytes += job->cycles(kept++).ByteSizeLong();
  }
  if (kept == job->cycles_size()) return;
  job->add_warnings(fmt::format(
      "only the first {} of {} cycles are in this answer; the artifact cycles.csv and the job's "
      "events have all",
      kept, job->cycles_size()));
  job->mutable_cycles()->DeleteSubrange(kept, job->cycles_size() - kept);
}

void SetSpan(std::chrono::milliseconds span, google::protobuf::Duration* duration) {
  *duration = google::protobuf::util::TimeUtil::MillisecondsToDuration(span.count());
}

}  // namespace

struct JobManager::Impl {
  Impl(Store& the_store, const Clock& the_clock, IdSource& the_ids, JobOptions the_options)
      : store(the_store),
        clock(the_clock),
        ids(the_ids),
        options(std::move(the_options)),
        scheduler(store, clock, options, feed),
        retention(store, clock, options.retention, feed) {}

  // One CreateJob on its way.
  struct Creation {
    v1::CreateJobRequest request;
    Callback<v1::Job> done;
    Abandoned abandoned;
    bool reserved;  ///< A place in the queue is kept for it.
  };

  void Check(const std::shared_ptr<Creation>& creation);
  void Accept(const std::shared_ptr<Creation>& creation);
  void Refuse(const Creation& creation, Error error);
  /// Adds to a stored header what is not stored.
  void Complete(v1::Job* job) const {
    if (const auto record = scheduler.Record(*job)) job->MergeFrom(record->Get(false));
    SetExpireTime(options.retention, job);
  }
  /// Answers with all of a stored job. Its ledger may be long, so it is parsed on the executor.
  void Answer(StoredJob stored, Callback<v1::Job> done);

  /// Counts one more; false if there are too many.
  bool AddWatcher();
  Watched Open(const v1::WatchJobRequest& request, WatchRules rules, v1::Job job,
               std::function<void()> wake);
  /// Makes a header of what the store and the worker know.
  void Complete(StoredJob* stored) const;

  Store& store;
  const Clock& clock;
  IdSource& ids;
  const JobOptions options;
  std::atomic<bool> draining = false;
  std::shared_ptr<std::atomic<int>> watchers = std::make_shared<std::atomic<int>>(0);
  JobFeed feed;
  Scheduler scheduler;
  Retention retention;
  /// Checks scenarios and reads series: too long for the callers' threads.
  Executor executor{"checker"};
  Executor decoder{"decoder"};  ///< Decodes what watchers read from the store.
  const EventSource source{store, decoder};
};

JobManager::JobManager(Store& store, const Clock& clock, IdSource& ids, JobOptions options)
    : impl_(std::make_unique<Impl>(store, clock, ids, std::move(options))) {
  impl_->retention.Start();
}

JobManager::~JobManager() { Stop(); }

void JobManager::Create(v1::CreateJobRequest request, Callback<v1::Job> done, Abandoned abandoned) {
  if (impl_->draining) return done(MakeError(Reason::kServerDraining));
  const bool reserved = !request.validate_only() && impl_->scheduler.Reserve();
  // A full queue still answers a request that was accepted before.
  if (!reserved && !request.validate_only() && request.request_id().empty()) {
    return done(QueueFull(impl_->options.max_queued_jobs));
  }
  const auto creation = std::make_shared<Impl::Creation>(
      Impl::Creation{std::move(request), std::move(done), std::move(abandoned), reserved});
  if (!impl_->executor.Post([impl = impl_.get(), creation] { impl->Check(creation); })) {
    impl_->Refuse(*creation, MakeError(Reason::kServerDraining));
  }
}

void JobManager::Impl::Refuse(const Creation& creation, Error error) {
  if (creation.reserved) scheduler.Release();
  creation.done(std::move(error));
}

void JobManager::Impl::Check(const std::shared_ptr<Creation>& creation) {
  if (creation->abandoned && creation->abandoned())
    return Refuse(*creation, MakeError(Reason::kDeadlineExceeded));
  const v1::CreateJobRequest& request = creation->request;
  std::vector<Violation> of_request = CheckCreate(request, options.max_budget);
  std::vector<Violation> of_spec;
  if (request.job().spec_case() != v1::Job::SPEC_NOT_SET) {
    of_spec = CheckSpec(request.job(), options.scenario_limits);
  }
  if (!of_request.empty() || !of_spec.empty()) {
    return Refuse(*creation, Invalid(std::move(of_request), std::move(of_spec)));
  }
  v1::Job job;
  MoveSpec(creation->request.mutable_job(), &job);
  *job.mutable_labels() = request.job().labels();
  CopySettings(request.job(), &job);
  if (request.validate_only()) {
    Predict(options.scenario_limits, &job);
    return creation->done(std::move(job));
  }
  *creation->request.mutable_job() = std::move(job);
  Accept(creation);
}

void JobManager::Impl::Accept(const std::shared_ptr<Creation>& creation) {
  v1::Job& job = *creation->request.mutable_job();
  job.set_name("jobs/" + ids.NextId());
  job.set_uid(ids.NextUuid());
  const std::vector<v1::Event> events = {
      Apply({v1::Job::QUEUED, reason::kWaitingForWorker}, clock.Now(), &job)};
  store.Create({job, creation->request.request_id(), events, creation->reserved},
               [this, creation, events](absl::StatusOr<StoredJob> stored) {
                 if (!creation->reserved && absl::IsResourceExhausted(stored.status())) {
                   return Refuse(*creation, QueueFull(options.max_queued_jobs));
                 }
                 if (!stored.ok()) return Refuse(*creation, ToError(stored.status(), ""));
                 if (!stored->created) {
                   if (creation->reserved) scheduler.Release();
                   return Answer(*std::move(stored), creation->done);
                 }
                 v1::Job& answer = stored->job;
                 options.metrics->Moved(v1::Job::STATE_UNSPECIFIED, answer);
                 MoveSpec(creation->request.mutable_job(), &answer);
                 scheduler.Enqueue(answer, events);
                 creation->done(std::move(answer));
               });
}

bool JobManager::Impl::AddWatcher() {
  if (++*watchers <= options.max_watchers) return true;
  --*watchers;
  return false;
}

void JobManager::Impl::Complete(StoredJob* stored) const {
  if (!stored->intact) DescribeDamage(&stored->job);
  Complete(&stored->job);
}

void JobManager::Impl::Answer(StoredJob stored, Callback<v1::Job> done) {
  // Asked for here, because on the store's thread the record exists exactly while the job has not
  // ended.
  const auto record = scheduler.Record(stored.job);
  const auto whole = std::make_shared<StoredJob>(std::move(stored));
  const auto answer = [this, record, whole, done = std::move(done)] {
    v1::Job& job = whole->job;
    if (!whole->MergeResult()) return done(ToError(FailsChecksum(job.name()), job.name()));
    if (record) job.MergeFrom(record->Get(true));
    SetExpireTime(options.retention, &job);
    ShortenLedger(&job);
    AddArtifacts(&job);
    done(std::move(job));
  };
  if (!executor.Post(answer)) answer();  // At the end nobody has to be spared.
}

void JobManager::Get(const std::string& name, Callback<v1::Job> done) {
  impl_->store.Read(
      name, JobPart::kAll,
      [impl = impl_.get(), name, done = std::move(done)](absl::StatusOr<StoredJob> stored) {
        if (!stored.ok()) return done(ToError(stored.status(), name));
        impl->Answer(*std::move(stored), done);
      });
}

void JobManager::List(const v1::ListJobsRequest& request, Callback<v1::ListJobsResponse> done) {
  Result<JobQuery> query = ToQuery(request);
  if (!query.ok()) return done(query.error());
  impl_->store.List(std::move(query.value()),
                    [impl = impl_.get(), done = std::move(done)](absl::StatusOr<JobPage> page) {
                      if (!page.ok()) return done(ToError(page.status(), ""));
                      v1::ListJobsResponse response;
                      for (StoredJob& stored : page->jobs) {
                        impl->Complete(&stored);
                        *response.add_jobs() = std::move(stored.job);
                      }
                      response.set_next_page_token(PageToken(page->next));
                      done(std::move(response));
                    });
}

void JobManager::Cancel(const v1::CancelJobRequest& request, Callback<v1::Job> done) {
  const std::string& name = request.name();
  const std::string& uid = request.expected_uid();
  // Of a job that has ended the scheduler knows nothing.
  auto checked = [uid, done = std::move(done)](Result<v1::Job> job) {
    const bool other = job.ok() && !uid.empty() && job.value().uid() != uid;
    done(other ? UidMismatch(job.value().name(), job.value().uid()) : std::move(job));
  };
  impl_->scheduler.Cancel(
      name, uid, [this, name, checked = std::move(checked)](const absl::Status& status) mutable {
        if (!status.ok()) return checked(ToError(status, name));
        Get(name, std::move(checked));
      });
}

void JobManager::Delete(const v1::DeleteJobRequest& request, Callback<bool> done) {
  const std::string& name = request.name();
  impl_->store.Delete(
      name, request.expected_uid(),
      [impl = impl_.get(), name, done = std::move(done)](const absl::StatusOr<bool>& deleted) {
        if (!deleted.ok()) return done(ToError(deleted.status(), name));
        impl->feed.Changed(name);
        done(true);
      });
}

void JobManager::Series(const v1::GetSeriesRequest& request, Callback<v1::Series> done,
                        Abandoned abandoned) {
  SeriesReader::Read(impl_->store, impl_->executor, impl_->options.scenario_limits, request,
                     {std::move(done), std::move(abandoned)});
}

void JobManager::Backup(std::stop_token stop, Callback<std::shared_ptr<BackupFile>> done) {
  impl_->store.Backup(std::move(stop),
                      [done = std::move(done)](absl::StatusOr<std::unique_ptr<BackupFile>> file) {
                        // Nobody asks any more, or the store is being closed.
                        if (absl::IsCancelled(file.status()))
                          return done(MakeError(Reason::kServerDraining));
                        if (!file.ok()) return done(ToError(file.status(), ""));
                        done(std::shared_ptr<BackupFile>(*std::move(file)));
                      });
}

void JobManager::Watch(const v1::WatchJobRequest& request, std::function<void()> wake,
                       Callback<Watched> done) {
  Result<WatchRules> rules = ToRules(request);
  if (!rules.ok()) return done(rules.error());
  if (!impl_->AddWatcher()) return done(WatcherLimit(impl_->options.max_watchers));
  impl_->store.Read(request.name(), JobPart::kSpec,
                    [impl = impl_.get(), request, rules = rules.value(), wake = std::move(wake),
                     done = std::move(done)](absl::StatusOr<StoredJob> stored) mutable {
                      if (!stored.ok()) {
                        --*impl->watchers;
                        return done(ToError(stored.status(), request.name()));
                      }
                      const v1::Job& job = stored->job;
                      if (!request.expected_uid().empty() && job.uid() != request.expected_uid()) {
                        --*impl->watchers;
                        return done(UidMismatch(job.name(), job.uid()));
                      }
                      done(impl->Open(request, rules, std::move(stored->job), std::move(wake)));
                    });
}

JobManager::Watched JobManager::Impl::Open(const v1::WatchJobRequest& request, WatchRules rules,
                                           v1::Job job, std::function<void()> wake) {
  auto log = scheduler.Log(request.name());
  if (!log) log = std::make_shared<JobLog>(job.last_sequence(), true);
  Complete(&job);
  if (job.has_sweep() && request.kinds().empty()) rules.kinds &= ~KindBit(v1::Event::kFrameChunk);
  auto tail = std::make_unique<TailCursor>(
      source, request.name(), std::move(log),
      request.live_only() ? job.last_sequence() : request.after_sequence(), rules.kinds,
      std::move(wake), watchers);
  auto behind = [&cursor = *tail] { return cursor.behind(); };
  auto cursor =
      std::make_unique<DeliveryCursor>(std::move(tail), std::move(behind), rules.delivery);
  return {std::move(job), std::move(cursor), rules.bookmark_interval,
          rules.delivery.min_frame_interval.count() > 0};
}

Result<JobManager::WatchedJobs> JobManager::Watch(const v1::WatchJobsRequest& request,
                                                  std::function<void()> wake) {
  Result<JobsRules> rules = ToRules(request);
  if (!rules.ok()) return rules.error();
  if (!impl_->AddWatcher()) return WatcherLimit(impl_->options.max_watchers);
  return WatchedJobs{std::make_unique<JobsCursor>(
                         impl_->store, impl_->feed, std::move(rules.value().filter),
                         [impl = impl_.get()](StoredJob* stored) { impl->Complete(stored); },
                         std::move(wake), impl_->watchers),
                     rules.value().bookmark_interval};
}

void JobManager::ReadArtifact(const v1::ReadArtifactRequest& request, std::function<void()> wake,
                              Callback<std::unique_ptr<ArtifactReader>> done) {
  if (request.offset() < 0) return done(OffsetOutOfRange(request.offset(), -1));
  if (!impl_->AddWatcher()) return done(WatcherLimit(impl_->options.max_watchers));
  impl_->store.Read(
      request.name(), JobPart::kAll,
      [impl = impl_.get(), request, wake = std::move(wake),
       done = std::move(done)](absl::StatusOr<StoredJob> stored) mutable {
        Result<ArtifactPlan> plan = stored.ok() ? PlanArtifact(*std::move(stored), request)
                                                : ToError(stored.status(), request.name());
        if (!plan.ok()) {
          --*impl->watchers;
          return done(plan.error());
        }
        done(std::make_unique<ArtifactReader>(impl->store, impl->executor, std::move(plan.value()),
                                              std::move(wake), impl->watchers));
      });
}

v1::ServerInfo JobManager::Info() const {
  const JobOptions& options = impl_->options;
  v1::ServerInfo info;
  info.set_workers(options.workers);
  info.set_queued_jobs(impl_->scheduler.queued());
  info.set_running_jobs(impl_->scheduler.running());
  v1::ServerLimits& limits = *info.mutable_limits();
  limits.set_max_bodies(options.scenario_limits.max_bodies);
  limits.set_max_contacts(options.scenario_limits.max_contacts);
  limits.set_max_samples(options.scenario_limits.max_samples);
  limits.set_max_queued_jobs(options.max_queued_jobs);
  limits.set_max_watchers(options.max_watchers);
  limits.set_max_cells(options.scenario_limits.max_cells);
  SetSpan(options.max_budget.wall_time, limits.mutable_max_budget()->mutable_wall_time());
  limits.mutable_max_budget()->set_steps(options.max_budget.steps);
  limits.mutable_max_budget()->set_output_bytes(options.max_budget.output_bytes);
  if (options.step_timeout.count() > 0) {
    SetSpan(options.step_timeout, limits.mutable_step_timeout());
  }
  limits.set_max_attempts(options.max_attempts);
  if (options.retention.age.count() > 0) SetSpan(options.retention.age, limits.mutable_retention());
  limits.set_retained_bytes(options.retention.bytes);
  if (options.retention.compact_after.count() > 0) {
    SetSpan(options.retention.compact_after, limits.mutable_compaction());
  }
  return info;
}

void JobManager::Drain() { impl_->draining = true; }

void JobManager::Stop() {
  Drain();
  impl_->executor.Stop();
  impl_->decoder.Stop();
  impl_->retention.Stop();
  impl_->scheduler.Stop();
  std::promise<void> flushed;
  // Twice: what Cancel asks of the store first makes it ask once more.
  impl_->store.Flush([&] { impl_->store.Flush([&] { flushed.set_value(); }); });
  flushed.get_future().wait();
}

}  // namespace contact
