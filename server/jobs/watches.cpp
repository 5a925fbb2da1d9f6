#include "jobs/watches.h"

#include <string>
#include <utility>

#include "jobs/log/delivery_cursor.h"
#include "jobs/log/jobs_cursor.h"

namespace contact {

void Watches::WatchJob(const Principal& caller, const v1::WatchJobRequest& request, Wake wake,
                       Callback<WatchedJob> done) {
  Result<WatchRules> rules = ToRules(request);
  if (!rules.ok()) return done(rules.error());
  Places::Place place = parts_.watchers.Take(caller);
  if (!place) return done(WatcherLimit(parts_.watchers.open(caller)));
  parts_.source.store.ReadOf(
      caller.tenant, request.name(), JobPart::kSpec,
      [this, request, rules = rules.value(), wake = std::move(wake), done = std::move(done),
       place = std::move(place)](absl::StatusOr<StoredJob> stored) mutable {
        const std::string& uid = request.expected_uid();
        if (stored.ok() && (uid.empty() || stored->job.uid() == uid)) {
          return done(Open(request, rules, *std::move(stored), std::move(wake), std::move(place)));
        }
        place = nullptr;
        done(stored.ok() ? UidMismatch(stored->job.name(), stored->job.uid())
                         : ToError(stored.status(), request.name()));
      });
}

WatchedJob Watches::Open(const v1::WatchJobRequest& request, WatchRules rules, StoredJob stored,
                         Wake wake, Places::Place place) {
  v1::Job& job = stored.job;
  auto log = parts_.unfinished.Log(job);
  parts_.reader.Complete(&stored);
  if (job.has_sweep() && request.kinds().empty()) rules.kinds &= ~KindBit(v1::Event::kFrameChunk);
  auto tail = std::make_unique<TailCursor>(
      parts_.source, job.name(), std::move(log),
      request.live_only() ? job.last_sequence() : request.after_sequence(), rules.kinds,
      std::move(wake), std::move(place));
  auto behind = [&cursor = *tail] { return cursor.behind(); };
  auto cursor = std::make_unique<DeliveryCursor>(std::move(tail), std::move(behind), parts_.clock,
                                                 rules.delivery);
  return {std::move(job), std::move(cursor), rules.bookmark_interval,
          rules.delivery.min_frame_interval.count() > 0, BudgetOf(parts_.watchers)};
}

Result<Watches::Jobs> Watches::WatchJobs(const Principal& caller,
                                         const v1::WatchJobsRequest& request, Wake wake) {
  Result<JobsCursor::Rules> rules = ToRules(request);
  if (!rules.ok()) return rules.error();
  rules.value().tenant = caller.tenant;
  rules.value().message_bytes = BudgetOf(parts_.watchers);
  Places::Place place = parts_.watchers.Take(caller);
  if (!place) return WatcherLimit(parts_.watchers.open(caller));
  return Jobs(std::make_unique<JobsCursor>(
      parts_.source.store, parts_.feed, parts_.clock, std::move(rules.value()),
      [this](StoredJob* stored) { parts_.reader.Complete(stored); }, std::move(wake),
      std::move(place)));
}

}  // namespace contact
