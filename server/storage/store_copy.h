#pragma once

#include <absl/status/statusor.h>

#include <cstdint>

#include "storage/store.h"

namespace contact {

/// What was copied.
struct CopyReport {
  std::int64_t jobs = 0;
  std::int64_t events = 0;
};

/// Copies every job with its log, spec, result, checkpoint and request id into an empty store, the
/// oldest first. Sequences stay; epochs begin anew, for nobody runs a job meanwhile. Waits for the
/// stores; nobody else may use them.
/// FAILED_PRECONDITION: the other store has jobs. DATA_LOSS: something is damaged; nothing damaged
/// is copied.
absl::StatusOr<CopyReport> CopyStore(Store& from, Store& to);

}  // namespace contact
