#pragma once

#include <chrono>
#include <optional>

#include "jobs/job/errors.h"

namespace contact {

/// What a source has for its stream.
struct StreamStep {
  /// The message in `out` is to be sent.
  bool has_message = false;
  /// The stream ends without error, after the message if there is one.
  bool ended = false;
  /// The stream ends with this error. Without one, see `ended`.
  std::optional<Error> error = {};
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

  /// True if Read may have something to send only because time has passed. Asked now and then while
  /// no message is under way; `now` is of the monotonic clock of all streams.
  virtual bool IsDue(std::chrono::steady_clock::time_point /*now*/) const { return false; }
};

}  // namespace contact
