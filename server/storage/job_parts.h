#pragma once

#include <absl/types/span.h>

#include <string>
#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "storage/event_coding.h"

namespace contact {

/// How messages become bytes: the pieces in which a job is stored, by how often they change.
/// Put together in any order they parse to the whole job.
struct JobParts {
  std::string header;  ///< All but the other two; rewritten at every transition.
  std::string spec;    ///< Spec and labels, as the client sent them. Equal jobs, equal bytes.
  std::string result;  ///< Cycles and final bodies, written once; empty if there are none.
  std::int64_t end_time = 0;  ///< See JobSize.
};
JobParts Split(const v1::Job& job);

/// A stored event: its kind (the field number of its payload) and its message. Making rows
/// compresses, so it is done before they reach the store's thread.
struct EventRow {
  int kind = 0;
  CodedEvent event;
};
std::vector<EventRow> ToRows(absl::Span<const v1::Event> events);

}  // namespace contact
