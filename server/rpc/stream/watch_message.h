#pragma once

#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/slice.h>

#include <cstdint>
#include <string>
#include <vector>

#include "contact/v1/job.pb.h"
#include "jobs/log/log_cursor.h"

namespace contact {

/// Composes a serialised WatchJobResponse of events that are serialised already. Small ones are
/// copied; the bytes of large ones are shared with the log and with whoever else watches.
class WatchMessage {
 public:
  void SetSnapshot(const v1::Job& job);
  void Add(const LogRecord& record);

  grpc::ByteBuffer Take();

 private:
  void Flush();

  std::string text_;  ///< Not in a slice yet.
  std::vector<grpc::Slice> slices_;
};

}  // namespace contact
