#include "rpc/stream/watch_loop.h"

#include <pthread.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace contact {

using std::chrono::steady_clock;

WatchLoop::WatchLoop(std::chrono::milliseconds tick) : tick_(tick), thread_([this] { Run(); }) {}

void WatchLoop::Add(const std::shared_ptr<Stream>& watcher) {
  bool draining = false;
  {
    const std::lock_guard lock(mutex_);
    watchers_.insert(watcher);
    draining = draining_;
  }
  if (draining) watcher->Drain();
}

void WatchLoop::Wake(const std::weak_ptr<Stream>& watcher) {
  const std::lock_guard lock(mutex_);
  // Whoever wakes a thousand, which may be a solver, wakes the thread once.
  if (woken_.empty()) changed_.notify_one();
  woken_.insert(watcher);
}

void WatchLoop::Drain() {
  {
    const std::lock_guard lock(mutex_);
    draining_ = true;
  }
  for (const auto& watcher : Alive()) watcher->Drain();
}

void WatchLoop::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

std::size_t WatchLoop::watchers() const {
  const std::lock_guard lock(mutex_);
  return static_cast<std::size_t>(
      std::ranges::count_if(watchers_, [](const auto& watcher) { return !watcher.expired(); }));
}

std::vector<std::shared_ptr<Stream>> WatchLoop::Alive() {
  std::vector<std::shared_ptr<Stream>> alive;
  const std::lock_guard lock(mutex_);
  std::erase_if(watchers_, [&alive](const auto& watcher) {
    if (auto strong = watcher.lock())
      alive.push_back(std::move(strong));
    else
      return true;
    return false;
  });
  return alive;
}

void WatchLoop::Tick(steady_clock::time_point now) {
  std::int64_t slow = 0;
  for (const auto& watcher : Alive()) slow += watcher->Tick(now) ? 1 : 0;
  metrics_->slow = slow;
}

void WatchLoop::Run() {
  pthread_setname_np(pthread_self(), "watch-loop");
  auto next_tick = steady_clock::now() + tick_;
  std::unique_lock lock(mutex_);
  while (!stopped_) {
    changed_.wait_until(lock, next_tick, [this] { return stopped_ || !woken_.empty(); });
    const Watchers woken = std::exchange(woken_, {});
    lock.unlock();
    for (const auto& watcher : woken) {
      if (const auto strong = watcher.lock()) strong->Poke();
    }
    if (const auto now = steady_clock::now(); now >= next_tick) {
      Tick(now);
      next_tick = now + tick_;
    }
    lock.lock();
  }
}

}  // namespace contact
