#pragma once

#include <future>
#include <memory>
#include <utility>

namespace contact {

/// Calls `start` with a callback that takes a T, and blocks until it was called; returns what it
/// was called with. `start` must see to it that the callback is called exactly once, on any thread.
/// The callback may still be running when this returns, and may be copied. Never call this on the
/// thread that is to call the callback.
template <class T, class Start>
T Await(Start start) {
  const auto promise = std::make_shared<std::promise<T>>();
  start([promise](T value) { promise->set_value(std::move(value)); });
  return promise->get_future().get();
}

}  // namespace contact
