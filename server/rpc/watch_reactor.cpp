#include "rpc/watch_reactor.h"

#include <spdlog/spdlog.h>

#include <utility>
#include <vector>

#include "rpc/status.h"

namespace contact {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::size_t kMaxBatchBytes = std::size_t{256} * 1024;
constexpr milliseconds kDefaultBookmarkInterval{10'000};
constexpr milliseconds kMinBookmarkInterval{1'000};
constexpr milliseconds kMaxBookmarkInterval{3'600'000};

milliseconds BookmarkInterval(const v1::WatchJobRequest& request) {
  if (!request.has_bookmark_interval()) return kDefaultBookmarkInterval;
  const auto& interval = request.bookmark_interval();
  if (interval.seconds() < 0 || interval.seconds() > 3600) return milliseconds{-1};
  return milliseconds{interval.seconds() * 1000 + interval.nanos() / 1'000'000};
}

grpc::Status BadInterval() {
  return ToGrpc({.code = absl::StatusCode::kInvalidArgument,
                 .reason = "FIELD_INVALID",
                 .message = "bookmark_interval must be in [1 s, 1 h]",
                 .violations = {{"bookmark_interval", "must be in [1 s, 1 h]", ""}}});
}

grpc::Status Draining() {
  return ToGrpc({.code = absl::StatusCode::kUnavailable,
                 .reason = "SERVER_DRAINING",
                 .message = "the server is shutting down; watch again",
                 .retry_after = std::chrono::seconds{1}});
}

grpc::Status Deleted(const std::string& name) {
  return ToGrpc({.code = absl::StatusCode::kNotFound,
                 .reason = "JOB_NOT_FOUND",
                 .message = name + " was deleted",
                 .metadata = {{"name", name}}});
}

grpc::Status Unreadable(const std::string& name) {
  return ToGrpc({.code = absl::StatusCode::kUnavailable,
                 .reason = "STORE_FAILED",
                 .message = "the events of " + name + " could not be read; watch again",
                 .retry_after = std::chrono::seconds{1}});
}

}  // namespace

WatchReactor* WatchReactor::Start(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                                  grpc::CallbackServerContext* context,
                                  const v1::WatchJobRequest& request, milliseconds write_stall) {
  const std::shared_ptr<WatchReactor> self(new WatchReactor(context, request, write_stall));
  self->self_ = self;
  if (self->bookmark_interval_ < kMinBookmarkInterval ||
      self->bookmark_interval_ > kMaxBookmarkInterval) {
    self->Step([&self] { self->EndWith(BadInterval()); });
  } else {
    self->Open(jobs, loop, request);
  }
  return self.get();  // Alive: gRPC calls OnDone only after it has been given the reactor.
}

WatchReactor::WatchReactor(grpc::CallbackServerContext* context, const v1::WatchJobRequest& request,
                           milliseconds write_stall)
    : name_(request.name()),
      write_stall_(write_stall),
      bookmark_interval_(BookmarkInterval(request)),
      context_(context) {}

void WatchReactor::Open(JobManager& jobs, const std::shared_ptr<WatchLoop>& loop,
                        const v1::WatchJobRequest& request) {
  const std::weak_ptr<WatchReactor> weak = self_;
  loop->Add(self_);
  jobs.Watch(
      request.name(), request.after_sequence(), {request.kinds().begin(), request.kinds().end()},
      [weak, loop] { loop->Wake(weak); },
      [weak](Result<JobManager::Watched> result) {
        if (const auto self = weak.lock()) self->Opened(std::move(result));
      });
}

void WatchReactor::Opened(Result<JobManager::Watched> result) {
  Step([&] {
    if (!result.ok()) return EndWith(ToGrpc(result.error()));
    cursor_ = std::move(result.value().cursor);
    snapshot_ = std::move(result.value().snapshot);
  });
}

void WatchReactor::Poke() {
  Step([] {});
}

void WatchReactor::Drain() {
  Step([this] { EndWith(Draining()); });
}

void WatchReactor::Tick(steady_clock::time_point now) {
  {
    const std::lock_guard lock(mutex_);
    if (state_ == State::kWriting && now - last_write_ > write_stall_) {
      spdlog::warn("job={} a watcher took nothing for {} ms and is dropped", name_,
                   write_stall_.count());
      context_->TryCancel();
      last_write_ = now;
    }
    if (state_ != State::kIdle || now - last_write_ < bookmark_interval_) return;
  }
  Poke();
}

template <class Change>
void WatchReactor::Step(Change change) {
  const auto keep = Self();
  if (!keep) return;
  State next;
  grpc::Status end;
  {
    const std::lock_guard lock(mutex_);
    change();
    if (state_ != State::kIdle) return;  // OnWriteDone comes back here.
    state_ = next = Choose();
    if (next == State::kWriting) last_write_ = steady_clock::now();
    if (next == State::kFinishing) end = *end_;
  }
  if (next == State::kWriting) StartWrite(&out_);
  if (next == State::kFinishing) Finish(end);
}

WatchReactor::State WatchReactor::Choose() {
  if (NextMessage()) return State::kWriting;
  return end_ ? State::kFinishing : State::kIdle;
}

// Puts what comes next into out_, or the reason why nothing will into end_.
bool WatchReactor::NextMessage() {
  if (end_ || !cursor_) return false;
  out_.Clear();
  if (snapshot_) {
    *out_.mutable_snapshot() = std::move(*std::exchange(snapshot_, std::nullopt));
    return true;
  }
  switch (cursor_->Read(kMaxBatchBytes, out_.mutable_events())) {
    case LogCursor::Next::kEvents:
      return true;
    case LogCursor::Next::kWait:
      return Bookmark();
    case LogCursor::Next::kEnd:
      EndWith(grpc::Status::OK);
      return false;
    case LogCursor::Next::kDeleted:
      EndWith(Deleted(name_));
      return false;
    case LogCursor::Next::kFailed:
      break;
  }
  EndWith(Unreadable(name_));
  return false;
}

bool WatchReactor::Bookmark() {
  if (steady_clock::now() - last_write_ < bookmark_interval_) return false;
  v1::Event* event = out_.add_events();
  event->set_sequence(cursor_->position());
  event->mutable_bookmark();
  return true;
}

void WatchReactor::EndWith(const grpc::Status& status) {
  if (!end_) end_ = status;
}

std::shared_ptr<WatchReactor> WatchReactor::Self() {
  const std::lock_guard lock(mutex_);
  return self_;
}

void WatchReactor::OnWriteDone(bool ok) {
  Step([this, ok] {
    state_ = State::kIdle;
    if (!ok) EndWith(grpc::Status::CANCELLED);
  });
}

void WatchReactor::OnCancel() {
  Step([this] { EndWith(grpc::Status::CANCELLED); });
}

void WatchReactor::OnDone() {
  std::shared_ptr<WatchReactor> last;  // Goes after the lock.
  const std::lock_guard lock(mutex_);
  state_ = State::kDone;
  last = std::move(self_);
}

}  // namespace contact
