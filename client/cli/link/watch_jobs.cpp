#include "cli/link/watch_jobs.h"

#include <map>
#include <set>
#include <utility>

#include "cli/link/stream_call.h"
#include "cli/link/stream_watch.h"

namespace contact::cli {
namespace {

class JobsWatcher final : public StreamWatch<JobsWatchOptions, JobsObserver> {
 public:
  using StreamWatch::StreamWatch;

 private:
  using Call = StreamCall<v1::WatchJobsResponse>;

  grpc::Status Connect() override {
    Call call([this](auto* context, auto* queue, void* tag) {
      return client_.stub().AsyncWatchJobs(context, options_.request, queue, tag);
    });
    unconfirmed_.clear();
    for (const auto& [name, version] : known_) unconfirmed_.insert(name);
    v1::WatchJobsResponse message;
    while (GoOn()) {
      const Call::Next next = call.Read(kStreamTick, &message);
      if (next == Call::Next::kEnd) return call.status();
      if (next == Call::Next::kMessage) Take(message);
    }
    return grpc::Status::OK;
  }

  void Take(const v1::WatchJobsResponse& message) {
    Heard();
    for (const v1::Job& job : message.jobs()) {
      unconfirmed_.erase(job.name());
      const std::pair version{job.state(), job.attempt()};
      const auto [known, is_new] = known_.emplace(job.name(), version);
      if (is_new || std::exchange(known->second, version) != version) observer_.OnJob(job);
    }
    for (const std::string& name : message.gone()) Forget(name);
    if (!message.snapshot_complete()) return;
    for (const std::string& name : std::exchange(unconfirmed_, {})) Forget(name);
  }

  void Forget(const std::string& name) {
    if (known_.erase(name) > 0) observer_.OnGone(name);
  }

  std::map<std::string, std::pair<v1::Job::State, int>> known_;  // State and attempt of each job.
  std::set<std::string> unconfirmed_;  // Known before this connection, and not in its snapshot yet.
};

}  // namespace

WatchEnd WatchJobs(Client& client, const JobsWatchOptions& options, JobsObserver& observer) {
  return JobsWatcher(client, options, observer).Follow();
}

}  // namespace contact::cli
