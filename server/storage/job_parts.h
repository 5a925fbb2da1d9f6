#pragma once

#include <absl/types/span.h>

#include <string>
#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "storage/event_coding.h"

namespace contact {

/// The pieces in which a job is stored, by how often they change. Each is a serialised v1::Job with
/// some of its fields; put together in any order they parse to the whole job.
struct JobParts {
  /// All fields but the spec, cycles, groups, final bodies and the note. Rewritten at every
  /// transition, also with labels from before a JobRemark, which is kept beside it.
  std::string header;
  /// What the client sent: spec, labels, priority, budget and time to live. Equal jobs give equal
  /// bytes.
  std::string spec;
  /// Cycles, groups and final bodies, written once; empty if there are none.
  std::string result;
  /// See JobSize.
  std::int64_t end_time = 0;
};

/// Serialises the pieces of a job.
JobParts Split(const v1::Job& job);

/// The title of the scenario, or of the base of the sweep; empty without one. The value of
/// Job.title, which the header keeps, because lists read no specs.
const std::string& TitleOf(const v1::Job& job);

/// Owner and tenant of the job; those of everybody, `local`, if it has none.
const std::string& OwnerOf(const v1::Job& job);
const std::string& TenantOf(const v1::Job& job);

/// An event to be stored.
struct EventRow {
  /// Field number of its payload.
  int kind = 0;
  CodedEvent event;
};

/// Serialises and compresses events. Takes long for frame chunks, so it is done before they reach
/// the store's thread.
std::vector<EventRow> ToRows(absl::Span<const v1::Event> events);

}  // namespace contact
