#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/byte_buffer.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "base/mutex.h"
#include "jobs/job/errors.h"

namespace contact {

/// What is in the bytes of a message, at all depths.
struct FieldCount {
  std::int64_t fields = 0;    ///< With those that are messages.
  std::int64_t messages = 0;  ///< Each may take 150 bytes once it is parsed, and two before.
};

/// Counts the fields in the bytes of a message, no further than just past `most` of either kind.
/// Nothing: the bytes are no message.
std::optional<FieldCount> CountFields(std::string_view bytes,
                                      const google::protobuf::Descriptor& type,
                                      const FieldCount& most);

/// Parses requests that may be large, and bounds the memory of those that are not answered yet.
/// Thread-safe; outlives the places that it gives.
class RequestBudget {
 public:
  /// `most`: bytes of memory that all of them may take; one that needs more alone is taken too.
  explicit RequestBudget(std::int64_t most) : most_(most) {}

  /// Parses `bytes` into `message`, and gives it a place in the budget until `place` goes.
  /// FIELD_INVALID: it is no such message, or has too many fields or messages. RATE_LIMITED: there
  /// is no place.
  std::optional<Error> Parse(const grpc::ByteBuffer& bytes, google::protobuf::Message* message,
                             std::shared_ptr<const void>* place);

 private:
  /// A place of so many bytes; null if there is none.
  std::shared_ptr<const void> Take(std::int64_t bytes);

  const std::int64_t most_;
  Mutex mutex_;
  /// Of all places.
  std::int64_t taken_ ABSL_GUARDED_BY(mutex_) = 0;
};

}  // namespace contact
