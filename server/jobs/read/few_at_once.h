#pragma once

#include <deque>
#include <functional>
#include <memory>

#include "base/mutex.h"

namespace contact {

/// Lets a few tasks be under way at a time; the others wait, in their order. Thread-safe.
class FewAtOnce {
 public:
  /// What a task keeps while it is under way. It may outlive the FewAtOnce.
  using Place = std::shared_ptr<const void>;
  /// Begins its work and returns; is called on the thread that asks or on one that gives a place
  /// back. Must not throw.
  using Task = std::function<void(Place)>;

  explicit FewAtOnce(int most) : state_(std::make_shared<State>(most)) {}

  /// Calls the task once, as soon as there is a place for it.
  void Run(Task task);

 private:
  struct State {
    explicit State(int most) : free(most) {}
    Mutex mutex;
    int free ABSL_GUARDED_BY(mutex);
    std::deque<Task> waiting ABSL_GUARDED_BY(mutex);
    /// True while a thread calls tasks: it calls those, too, whose place comes free meanwhile.
    bool calling ABSL_GUARDED_BY(mutex) = false;
  };

  /// Calls tasks as long as there is a place for one.
  static void Call(const std::shared_ptr<State>& state);
  /// The next task, if there is a place for it, which it takes; else none, and nobody calls any
  /// more.
  static Task Next(State& state);

  const std::shared_ptr<State> state_;
};

}  // namespace contact
