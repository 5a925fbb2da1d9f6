#pragma once

#include <grpcpp/support/status.h>

#include <chrono>
#include <optional>

namespace contact {

/// What a source has for its stream.
struct StreamStep {
  bool has_message = false;              ///< The message in `out` is to be sent.
  std::optional<grpc::Status> end = {};  ///< The stream ends so, after the message if there is one.
};

/// Where the messages of one stream come from. The stream calls it under the stream's lock, from
/// any thread. A source never blocks, and never calls its stream: when it has something new, it
/// calls the `wake` that it was opened with. It is destroyed before the client learns of the end.
template <class Message>
class StreamSource {
 public:
  virtual ~StreamSource() = default;

  /// Puts the next message into `out`, which is empty. A step without message and end means that
  /// there is nothing to send now.
  virtual StreamStep Read(Message* out) = 0;

  /// True if Read may have something to send only because time has passed. Asked at each tick of
  /// the StreamLoop while no message is under way; `now` is of the loop's monotonic clock.
  virtual bool IsDue(std::chrono::steady_clock::time_point /*now*/) const { return false; }
};

}  // namespace contact
