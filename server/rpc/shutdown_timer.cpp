#include "rpc/shutdown_timer.h"

#include <pthread.h>

#include <utility>

namespace contact {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

ShutdownTimer::ShutdownTimer(milliseconds patience, Action urge, milliseconds limit, Action give_up)
    : thread_([this, patience, urge = std::move(urge), limit, give_up = std::move(give_up)] {
        pthread_setname_np(pthread_self(), "shutdown-timer");
        const auto begin = steady_clock::now();
        if (DoneBy(begin + patience)) return;
        urge();
        if (!DoneBy(begin + limit)) give_up();
      }) {}

ShutdownTimer::~ShutdownTimer() {
  {
    const MutexLock lock(mutex_);
    done_ = true;
    changed_.notify_one();
  }
  thread_.join();
}

bool ShutdownTimer::DoneBy(steady_clock::time_point end) {
  const MutexLock lock(mutex_);
  while (!done_) {
    if (changed_.wait_until(mutex_, end) == std::cv_status::timeout) break;
  }
  return done_;
}

}  // namespace contact
