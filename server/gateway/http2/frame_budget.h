#pragma once

#include <chrono>
#include <cstddef>

namespace contact::gateway {

/// Bounds the frames that do no work: nghttp2 1.52 takes any number of PRIORITY, WINDOW_UPDATE and
/// empty DATA. In a second a connection may send some for nothing, and more beside bytes that are
/// moved and calls that are answered.
class FrameBudget {
 public:
  using Time = std::chrono::steady_clock::time_point;

  void Add() { ++frames_; }
  /// Payload that came or went.
  void Moved(std::size_t bytes) { moved_ += bytes; }
  /// A call was answered, for which a few frames are needed.
  void Answered() { moved_ += kBytesOfCall; }

  /// True if more frames came since the second began than its work needs.
  bool Spent(Time now) {
    if (now - begin_ > std::chrono::seconds(1)) {
      begin_ = now;
      frames_ = moved_ = 0;
    }
    return frames_ > kFree + moved_ / kBytesOfFrame;
  }

 private:
  // An honest client at 39,000 calls a second sends 100,000 frames; a flood of PING or PRIORITY
  // several millions, of which 20,000 take some ms.
  static constexpr std::size_t kFree = 20'000;
  static constexpr std::size_t kBytesOfFrame = 256;
  static constexpr std::size_t kBytesOfCall = 8 * kBytesOfFrame;

  Time begin_ = {};
  std::size_t frames_ = 0;
  std::size_t moved_ = 0;
};

}  // namespace contact::gateway
