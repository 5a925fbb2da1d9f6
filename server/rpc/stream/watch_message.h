#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/slice.h>

#include <cstdint>
#include <string>
#include <vector>

#include "contact/v1/job.pb.h"
#include "jobs/log/log_cursor.h"

namespace contact {

/// Composes a serialised WatchJobResponse of events that are serialised already. Small events are
/// copied; the bytes of large ones are shared with the log and with other watchers.
class WatchMessage {
 public:
  /// Adds the snapshot field.
  void SetSnapshot(const v1::Job& job);
  /// Adds an event, with the record's sequence unless that is 0.
  void Add(const LogRecord& record);

  /// The message; afterwards this is empty.
  grpc::ByteBuffer Take();

 private:
  /// Makes a slice of text_.
  void Flush();

  /// Bytes that are not in a slice yet.
  std::string text_;
  /// The message up to text_.
  std::vector<grpc::Slice> slices_;
};

}  // namespace contact
