#include "rpc/stream/stream_loop.h"

#include <pthread.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace contact {
namespace {

using namespace std::chrono_literals;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

milliseconds TickOf(milliseconds write_stall) { return std::clamp(write_stall / 4, 10ms, 500ms); }

}  // namespace

StreamLoop::StreamLoop(const Clock& clock, milliseconds write_stall)
    : clock_(clock),
      write_stall_(write_stall),
      thread_([this](const std::stop_token& stop) { Run(stop); }) {}

void StreamLoop::Add(const std::shared_ptr<Stream>& stream) {
  bool draining = false;
  {
    const MutexLock lock(mutex_);
    streams_.insert(stream);
    draining = draining_;
  }
  if (draining) stream->Drain();
}

void StreamLoop::Wake(const std::weak_ptr<Stream>& stream) {
  const MutexLock lock(mutex_);
  // A solver may wake a thousand streams: only the first one costs a notification.
  if (woken_.empty()) changed_.notify_one();
  woken_.insert(stream);
}

void StreamLoop::Drain() {
  {
    const MutexLock lock(mutex_);
    draining_ = true;
  }
  for (const auto& stream : Alive()) stream->Drain();
}

void StreamLoop::Stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

std::size_t StreamLoop::streams() const {
  const MutexLock lock(mutex_);
  return static_cast<std::size_t>(
      std::ranges::count_if(streams_, [](const auto& stream) { return !stream.expired(); }));
}

std::vector<std::shared_ptr<Stream>> StreamLoop::Alive() {
  std::vector<std::shared_ptr<Stream>> alive;
  const MutexLock lock(mutex_);
  std::erase_if(streams_, [&alive](const auto& stream) {
    auto strong = stream.lock();
    if (strong) alive.push_back(std::move(strong));
    return stream.expired();
  });
  return alive;
}

void StreamLoop::Tick(steady_clock::time_point now) {
  std::int64_t slow = 0;
  for (const auto& stream : Alive()) slow += stream->Tick(now) ? 1 : 0;
  metrics_->slow = slow;
}

StreamLoop::Streams StreamLoop::Await(const std::stop_token& stop, steady_clock::time_point end) {
  const MutexLock lock(mutex_);
  changed_.wait_until(mutex_, stop, end,
                      [this]() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) { return !woken_.empty(); });
  return std::exchange(woken_, {});
}

void StreamLoop::Run(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "streams");
  const milliseconds tick = TickOf(write_stall_);
  auto next_tick = steady_clock::now() + tick;
  for (;;) {
    const Streams woken = Await(stop, next_tick);
    if (stop.stop_requested()) return;
    for (const auto& stream : woken) {
      if (const auto strong = stream.lock()) strong->Poke();
    }
    if (const auto now = steady_clock::now(); now >= next_tick) {
      Tick(clock_.Elapsed());
      next_tick = now + tick;
    }
  }
}

}  // namespace contact
