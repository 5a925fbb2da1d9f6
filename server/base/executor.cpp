#include "base/executor.h"

#include <pthread.h>

#include <utility>

namespace contact {

Executor::Executor(const char* name)
    : thread_([this, name] {
        pthread_setname_np(pthread_self(), name);
        Loop();
      }) {}

Executor::~Executor() { Stop(); }

bool Executor::Post(Task task) {
  const MutexLock lock(mutex_);
  if (stopping_) return false;
  tasks_.push_back(std::move(task));
  posted_.notify_one();
  return true;
}

void Executor::Stop() {
  {
    const MutexLock lock(mutex_);
    stopping_ = true;
    posted_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void Executor::Loop() {
  for (;;) {
    Task task;
    {
      const MutexLock lock(mutex_);
      while (tasks_.empty() && !stopping_) posted_.wait(mutex_);
      if (tasks_.empty()) return;
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
  }
}

}  // namespace contact
