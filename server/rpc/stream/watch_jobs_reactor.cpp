#include "rpc/stream/watch_jobs_reactor.h"

#include <utility>

#include "jobs/job/job_errors.h"
#include "rpc/call/status.h"

namespace contact {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

WatchJobsReactor* WatchJobsReactor::Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                                          grpc::CallbackServerContext* context,
                                          const v1::WatchJobsRequest& request,
                                          milliseconds write_stall) {
  const std::shared_ptr<WatchJobsReactor> self(
      new WatchJobsReactor(context, write_stall, loop->metrics()));
  self->Own(self);
  loop->Add(self);
  auto result =
      jobs.Watch(request, [stream = std::weak_ptr<Stream>(self), loop] { loop->Wake(stream); });
  self->Step([&] {
    if (!result.ok()) return self->EndWith(ToGrpc(result.error()));
    self->watched_ = std::move(result.value());
  });
  return self.get();  // Alive: gRPC calls OnDone only after it has been given the reactor.
}

bool WatchJobsReactor::Next(v1::WatchJobsResponse* out) {
  if (!watched_.cursor) return false;
  switch (watched_.cursor->Read(out)) {
    case JobsCursor::Next::kMessage:
      return true;
    case JobsCursor::Next::kWait:
      out->set_snapshot_complete(watched_.cursor->listed());
      return steady_clock::now() - last_write() >= watched_.bookmark_interval;
    case JobsCursor::Next::kSlow:
      EndWith(ToGrpc(SlowWatcher("jobs")));
      return false;
    case JobsCursor::Next::kFailed:
      EndWith(StreamUnreadable("jobs"));
      return false;
  }
  return false;
}

bool WatchJobsReactor::IsDue(steady_clock::time_point now) const {
  return watched_.cursor && now - last_write() >= watched_.bookmark_interval;
}

}  // namespace contact
