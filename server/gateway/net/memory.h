#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

namespace contact::gateway {

/// Counts memory that many share, and has none itself. Thread-safe.
class Memory {
 public:
  struct GiveBack {
    std::size_t bytes = 0;
    void operator()(Memory* memory) const { memory->taken_ -= bytes; }
  };
  /// A part of the memory until it goes; null if there was not so much left.
  using Share = std::unique_ptr<Memory, GiveBack>;

  explicit Memory(std::size_t most) : most_(most) {}

  /// Takes so much for one message. A small one is not counted, so that it never lacks room.
  Share Take(std::size_t bytes);

 private:
  const std::size_t most_;
  std::atomic<std::size_t> taken_ = 0;
};

}  // namespace contact::gateway
