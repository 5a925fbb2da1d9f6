#include "jobs/read/few_at_once.h"

#include <utility>

namespace contact {

void FewAtOnce::Run(Task task) {
  {
    const MutexLock lock(state_->mutex);
    state_->waiting.push_back(std::move(task));
    if (std::exchange(state_->calling, true)) return;
  }
  Call(state_);
}

void FewAtOnce::Call(const std::shared_ptr<State>& state) {
  while (const Task task = Next(*state)) {
    task(Place(state.get(), [state](const void*) {
      {
        const MutexLock lock(state->mutex);
        ++state->free;
        if (std::exchange(state->calling, true)) return;
      }
      Call(state);
    }));
  }
}

FewAtOnce::Task FewAtOnce::Next(State& state) {
  const MutexLock lock(state.mutex);
  if (state.free == 0 || state.waiting.empty()) {
    state.calling = false;
    return nullptr;
  }
  --state.free;
  Task task = std::move(state.waiting.front());
  state.waiting.pop_front();
  return task;
}

}  // namespace contact
