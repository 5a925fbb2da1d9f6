#pragma once

#include <absl/types/span.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "storage/event_coding.h"

namespace contact {

/// A job to be created. Only looked at during the call.
struct NewJob {
  const v1::Job& job;                  ///< `name` is new; its output fields are stored as they are.
  const std::string& request_id;       ///< Empty: none.
  absl::Span<const v1::Event> events;  ///< The first of its log, without sequence.
  bool may_create = true;  ///< False: only answer a repeated request; RESOURCE_EXHAUSTED if new.
};

/// Where the run of a job may go on after a crash. Goes when the job ends.
struct Checkpoint {
  std::size_t events = 0;  ///< Of the update, those that came before it.
  std::string state;       ///< For whoever runs it.
};

/// A change of a job, written as a whole. Only looked at during the call.
struct JobUpdate {
  const std::string& name;
  std::uint64_t epoch = 0;  ///< The job must have this one, else ABORTED: another owner took it.
  bool take = false;        ///< Take the job: its epoch becomes `epoch` + 1.
  const v1::Job* job = nullptr;  ///< Replaces the stored job, except for its spec; or null.
  absl::Span<const v1::Event> events = {};  ///< Appended to its log, without sequence.
  const Checkpoint* checkpoint = nullptr;   ///< Replaces the one before; or null.
};

/// Payload of a status: the uid of the job that was found in place of the one expected.
inline constexpr char kUidPayload[] = "contact/uid";

/// What of a job to read.
enum class JobPart {
  kHeader,  ///< All but spec, cycles and final bodies.
  kSpec,    ///< Header and spec.
  kRun,     ///< The same, and the checkpoint.
  kAll,     ///< Header, spec, and the result: cycles and final bodies, not parsed.
};

struct StoredJob {
  v1::Job job;
  std::uint64_t epoch = 0;
  bool cancel_requested = false;
  bool compacted = false;  ///< By Compact.
  bool created = false;    ///< By this call of Create.
  bool intact = true;      ///< False: fails its checksum; only name, state and sequences are true.
  std::string checkpoint = {};            ///< Empty: none, or a damaged one.
  std::uint64_t checkpoint_sequence = 0;  ///< Of the last event before it.
  std::string result = {};                ///< As it is stored; empty: none, or not asked for.
  std::int64_t result_crc32 = 0;

  /// Puts the result into the job. A long ledger takes a while: not for the store's thread. False
  /// if it is damaged.
  bool MergeResult();
};

struct JobQuery {
  std::vector<int> states = {};                                  ///< One of these; empty: all.
  std::vector<std::pair<std::string, std::string>> labels = {};  ///< All of these.
  std::int64_t before = 0;  ///< JobPage::next of the page before; 0: from the newest.
  int limit = 50;
};

struct JobPage {
  std::vector<StoredJob> jobs;  ///< Headers, newest first.
  std::int64_t next = 0;        ///< 0: no more.
};

/// What an ended job takes.
struct JobSize {
  std::string name;
  std::int64_t end_time = 0;  ///< Unix time in seconds; 0 if the job does not tell.
  std::int64_t bytes = 0;     ///< Stored of its events, spec and result.
};

struct EventQuery {
  std::string name;
  std::uint64_t after = 0;          ///< Only events after this sequence.
  std::uint32_t kinds = ~0U;        ///< Only kinds k with bit k set; see KindBit.
  std::size_t max_bytes = 1 << 18;  ///< About, decoded; at least one event is read.
};

inline std::uint32_t KindBit(v1::Event::PayloadCase kind) { return 1U << kind; }

struct StoredEvent {
  std::uint64_t sequence = 0;
  v1::Event::PayloadCase kind = v1::Event::PAYLOAD_NOT_SET;
  Coding coding = Coding::kPlain;
  std::string bytes;   ///< As they are stored; empty if not intact.
  bool intact = true;  ///< False: fails its checksum.

  /// Decodes the event, without sequence. Takes a while for a frame chunk: not for the store's
  /// thread. False if it is damaged.
  bool Parse(v1::Event* event) const;
  /// The same as a serialised message. Takes the bytes.
  bool TakePayload(std::string* payload);
};

struct EventPage {
  std::vector<StoredEvent> events;
  std::uint64_t position = 0;  ///< All events asked for up to here have been read.
  std::uint64_t oldest = 1;    ///< From here on all are there; before it frame chunks were dropped.
};

}  // namespace contact
