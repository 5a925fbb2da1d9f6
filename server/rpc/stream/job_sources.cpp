#include "rpc/stream/job_sources.h"

#include <chrono>
#include <utility>

#include "jobs/job/errors.h"
#include "rpc/call/status.h"

namespace contact {
namespace {

using std::chrono::steady_clock;

class JobsSource final : public StreamSource<v1::WatchJobsResponse> {
 public:
  JobsSource(JobManager::WatchedJobs watched, const Clock& clock)
      : watched_(std::move(watched)), clock_(clock), last_sent_(clock.Elapsed()) {}

  StreamStep Read(v1::WatchJobsResponse* out) override {
    const auto now = clock_.Elapsed();
    bool send = false;
    switch (watched_.cursor->Read(out)) {
      case JobsCursor::Next::kMessage:
        send = true;
        break;
      case JobsCursor::Next::kWait:
        out->set_snapshot_complete(watched_.cursor->listed());
        send = IsDue(now);
        break;
      case JobsCursor::Next::kSlow:
        return {.end = ToGrpc(SlowWatcher("jobs"))};
      case JobsCursor::Next::kFailed:
        return {.end = ToGrpc(Unreadable("jobs"))};
    }
    if (send) last_sent_ = now;
    return {.has_message = send};
  }

  bool IsDue(steady_clock::time_point now) const override {
    return now - last_sent_ >= watched_.bookmark_interval;
  }

 private:
  const JobManager::WatchedJobs watched_;
  const Clock& clock_;
  steady_clock::time_point last_sent_;
};

class ArtifactSource final : public StreamSource<v1::ReadArtifactResponse> {
 public:
  explicit ArtifactSource(std::unique_ptr<ArtifactReader> reader) : reader_(std::move(reader)) {}

  StreamStep Read(v1::ReadArtifactResponse* out) override {
    switch (reader_->Read(out)) {
      case ArtifactReader::Next::kData:
        return {.has_message = true};
      case ArtifactReader::Next::kWait:
        return {};
      case ArtifactReader::Next::kEnd:
        return {.has_message = true, .end = grpc::Status::OK};
      case ArtifactReader::Next::kFailed:
        return {.end = ToGrpc(reader_->error())};
    }
    return {};
  }

 private:
  const std::unique_ptr<ArtifactReader> reader_;
};

}  // namespace

std::unique_ptr<StreamSource<v1::WatchJobsResponse>> MakeJobsSource(JobManager::WatchedJobs watched,
                                                                    const Clock& clock) {
  return std::make_unique<JobsSource>(std::move(watched), clock);
}

std::unique_ptr<StreamSource<v1::ReadArtifactResponse>> MakeArtifactSource(
    std::unique_ptr<ArtifactReader> reader) {
  return std::make_unique<ArtifactSource>(std::move(reader));
}

}  // namespace contact
