#include "rpc/shutdown_timer.h"

#include <pthread.h>

#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <utility>

namespace contact {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// Waits until `end`. True if `stop` was requested before.
bool StoppedBefore(steady_clock::time_point end, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  const auto stopped = [&stop] { return stop.stop_requested(); };
  // What it returns is what it saw last; libstdc++ may say false where the stop came just after.
  std::condition_variable_any().wait_until(lock, stop, end, stopped);
  return stopped();
}

}  // namespace

ShutdownTimer::ShutdownTimer(milliseconds limit, Action give_up)
    : thread_([limit, give_up = std::move(give_up)](const std::stop_token& stop) {
        pthread_setname_np(pthread_self(), "shutdown-timer");
        if (!StoppedBefore(steady_clock::now() + limit, stop)) give_up();
      }) {}

}  // namespace contact
