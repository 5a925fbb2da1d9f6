#pragma once

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "contact/v1/job_service.grpc.pb.h"

namespace contact::testing {

/// Many watchers of one job on a few connections. Some read only their first message.
class WatchCrowd {
 public:
  struct Options {
    std::string address;
    v1::WatchJobRequest request;
    int connections = 1;
    int watchers = 1;
    int stalled = 0;  ///< So many of them stop reading.
  };

  /// What all of them got until now.
  struct Figures {
    int attached = 0;  ///< Have their first message.
    int ended = 0;     ///< Their stream ended with OK.
    int failed = 0;    ///< It ended otherwise.
    std::int64_t events = 0;
    std::int64_t bytes = 0;
    std::vector<double> latencies_ms;  ///< From server's stamp to receipt, sorted; live events.
  };

  explicit WatchCrowd(const Options& options) : watching_(options.watchers) {
    for (int i = 0; i < options.connections; ++i) stubs_.push_back(Connect(options.address));
    for (int i = 0; i < options.watchers; ++i) {
      watchers_.push_back(std::make_unique<Watcher>(*this, options.request, i < options.stalled));
      watchers_.back()->Start(*stubs_[static_cast<std::size_t>(i) % stubs_.size()]);
    }
  }

  /// Leaves, and waits until gRPC has let go.
  ~WatchCrowd() {
    for (const auto& watcher : watchers_) watcher->Cancel();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return watching_ == 0; });
  }

  WatchCrowd(const WatchCrowd&) = delete;
  WatchCrowd& operator=(const WatchCrowd&) = delete;

  /// Waits until all have their first message. False: one failed, or it took too long.
  bool AwaitAttached(std::chrono::seconds limit) {
    std::unique_lock lock(mutex_);
    const int all = static_cast<int>(watchers_.size());
    changed_.wait_for(lock, limit,
                      [this, all] { return figures_.failed > 0 || figures_.attached == all; });
    return figures_.attached == all;
  }

  /// Waits until no stream is left but those of the stalled. False: it took too long.
  bool AwaitEnded(int stalled, std::chrono::seconds limit) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, limit, [this, stalled] { return watching_ <= stalled; });
  }

  Figures figures() const {
    const std::lock_guard lock(mutex_);
    Figures figures = figures_;
    std::ranges::sort(figures.latencies_ms);
    return figures;
  }

 private:
  using Clock = std::chrono::system_clock;

  class Watcher final : public grpc::ClientReadReactor<v1::WatchJobResponse> {
   public:
    Watcher(WatchCrowd& crowd, v1::WatchJobRequest request, bool stalls)
        : crowd_(crowd), request_(std::move(request)), stalls_(stalls) {}

    void Start(v1::JobService::Stub& stub) {
      stub.async()->WatchJob(&context_, &request_, this);
      StartRead(&message_);
      if (stalls_) AddHold();  // A read will come, when it is cancelled.
      StartCall();
    }

    void Cancel() {
      context_.TryCancel();
      if (stalls_ && !left_.exchange(true)) RemoveHold();
    }

    void OnReadDone(bool ok) override {
      if (!ok) return;
      crowd_.Receive(message_, std::exchange(first_, false), begin_);
      if (!stalls_) StartRead(&message_);
    }

    void OnDone(const grpc::Status& status) override { crowd_.Leave(status); }

   private:
    WatchCrowd& crowd_;
    const v1::WatchJobRequest request_;
    const bool stalls_;
    const Clock::time_point begin_ = Clock::now();
    bool first_ = true;
    std::atomic<bool> left_ = false;
    grpc::ClientContext context_;
    v1::WatchJobResponse message_;
  };

  static std::unique_ptr<v1::JobService::Stub> Connect(const std::string& address) {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);  // A connection of its own.
    arguments.SetMaxReceiveMessageSize(-1);
    return v1::JobService::NewStub(
        grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments));
  }

  static Clock::time_point TimeOf(const v1::Event& event) {
    const auto& stamp = event.event_time();
    return Clock::time_point(std::chrono::seconds(stamp.seconds()) +
                             std::chrono::nanoseconds(stamp.nanos()));
  }

  void Receive(const v1::WatchJobResponse& message, bool first, Clock::time_point begin) {
    const auto now = Clock::now();
    const std::lock_guard lock(mutex_);
    figures_.events += message.events_size();
    figures_.bytes += static_cast<std::int64_t>(message.ByteSizeLong());
    for (const v1::Event& event : message.events()) {
      if (!event.has_event_time() || TimeOf(event) < begin) continue;
      const std::chrono::duration<double, std::milli> latency = now - TimeOf(event);
      figures_.latencies_ms.push_back(latency.count());
    }
    if (!first) return;
    ++figures_.attached;
    changed_.notify_all();
  }

  void Leave(const grpc::Status& status) {
    const std::lock_guard lock(mutex_);
    ++(status.ok() ? figures_.ended : figures_.failed);
    --watching_;
    changed_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  int watching_;
  Figures figures_;
  std::vector<std::unique_ptr<v1::JobService::Stub>> stubs_;
  std::vector<std::unique_ptr<Watcher>> watchers_;
};

/// The value below which `percent` of the sorted values lie; 0 if there are none.
inline double Percentile(const std::vector<double>& sorted, double percent) {
  if (sorted.empty()) return 0;
  const auto index = static_cast<std::size_t>(percent / 100 * static_cast<double>(sorted.size()));
  return sorted[std::min(index, sorted.size() - 1)];
}

}  // namespace contact::testing
