#include "jobs/schedule/worker_pool.h"

#include <pthread.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <mutex>
#include <system_error>

namespace contact {
namespace {

constexpr std::chrono::milliseconds kIdleLookTime{10};

// More than enough for whoever answers calls and commits to come first; less than would let a run
// starve beside other programs.
constexpr int kNiceness = 10;

// Solving is batch work and answering is not: without this a submit waits behind the solvers for a
// core. On Linux each thread has a nice value of its own.
void StepBack() {
  pthread_setname_np(pthread_self(), "worker");
  if (setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness) == 0) return;
  static std::once_flag told;
  std::call_once(told, [error = errno] {
    spdlog::warn("workers cannot step back behind those who answer: setpriority: {}",
                 std::generic_category().message(error));
  });
}

}  // namespace

void Worker::Begin(std::shared_ptr<RunControl> run) {
  const MutexLock lock(mutex_);
  run_ = std::move(run);
}

bool Worker::End() {
  const MutexLock lock(mutex_);
  run_ = nullptr;
  return !lost_;
}

bool Worker::Abandon(const RunControl& run) {
  const MutexLock lock(mutex_);
  if (lost_ || run_.get() != &run) return false;
  return lost_ = true;
}

void Worker::Finish() {
  const MutexLock lock(mutex_);
  finished_ = true;
  changed_.notify_all();
}

bool Worker::AwaitFinish(std::chrono::milliseconds* patience) {
  const MutexLock lock(mutex_);
  while (!finished_) {
    const bool late = patience->count() <= 0;
    if (late && !lost_ && run_ && run_->GiveUp()) lost_ = true;
    if (late && lost_) return false;
    if (changed_.wait_for(mutex_, kIdleLookTime) == std::cv_status::timeout) {
      *patience -= kIdleLookTime;
    }
  }
  return true;
}

void WorkerPool::Start(int threads) {
  const MutexLock lock(mutex_);
  for (int i = 0; i < threads; ++i) {
    auto worker = std::make_shared<Worker>();
    std::thread thread([worker, loop = loop_] {
      StepBack();
      loop(*worker);
      worker->Finish();
    });
    members_.push_back({std::move(worker), std::move(thread)});
  }
}

int WorkerPool::Replace(const RunControl& run) {
  int lost = 0;
  {
    const MutexLock lock(mutex_);
    for (const Member& member : members_) lost += member.worker->Abandon(run) ? 1 : 0;
  }
  if (lost > 0) spdlog::warn("{} worker threads hang in a run; others take their place", lost);
  Start(lost);
  return lost;
}

void WorkerPool::Stop(std::chrono::milliseconds patience) {
  std::vector<Member> members;
  {
    const MutexLock lock(mutex_);
    members.swap(members_);
  }
  for (Member& member : members) {
    if (member.worker->AwaitFinish(&patience)) {
      member.thread.join();
    } else {
      spdlog::warn("a worker thread hangs in a run; it is left behind");
      member.thread.detach();
    }
  }
}

}  // namespace contact
