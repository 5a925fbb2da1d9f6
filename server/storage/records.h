#pragma once

#include <absl/types/span.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"
#include "storage/event_coding.h"

namespace contact {

/// Labels of a job, each key once; see v1::Job.labels.
using JobLabels = std::map<std::string, std::string>;

/// What there may be of jobs that have not ended, for one more to be created; 0: any number. An
/// engine that many processes share counts them; where one process owns the store, it does.
struct UnfinishedLimits {
  /// Jobs that wait for a worker.
  std::int64_t waiting = 0;
  /// Jobs of the owner.
  std::int64_t owner_jobs = 0;
  /// Cells of the owner's sweeps.
  std::int64_t owner_cells = 0;
};

/// A job to be created. Only looked at during the call.
struct NewJob {
  /// Its `name` is new. Its output fields are stored as they are.
  const v1::Job& job;
  /// Empty: none.
  const std::string& request_id;
  /// The first events of its log, without sequence.
  absl::Span<const v1::Event> events;
  /// False: a repeated request is answered, a new one is RESOURCE_EXHAUSTED.
  bool may_create = true;
  /// A new job is refused with kOwnerBytesPayload if the jobs of its owner take so many bytes
  /// already; 0: never.
  std::int64_t max_owner_bytes = 0;
  /// A new job that would exceed them is refused with the payload of what there is too much of.
  UnfinishedLimits limits = {};
};

/// Where the run of a job may go on after a crash. Removed when the job ends.
struct Checkpoint {
  /// How many events of the same update came before the checkpoint.
  std::size_t events = 0;
  /// Bytes that only the program that runs the job understands.
  std::string state;
};

/// A change of a job, written as a whole. Only looked at during the call.
struct JobUpdate {
  const std::string& name;
  /// The epoch that the job must have, else ABORTED: another owner took it, or it has ended.
  std::uint64_t epoch = 0;
  /// Takes the job: its epoch becomes `epoch` + 1.
  bool take = false;
  /// Replaces the stored job, except for its spec; or null.
  const v1::Job* job = nullptr;
  /// Appended to the log of the job, without sequence.
  absl::Span<const v1::Event> events = {};
  /// Replaces the checkpoint of the job; or null.
  const Checkpoint* checkpoint = nullptr;
};

/// What people say of a job from now on, whatever its state and whoever runs it.
struct JobRemark {
  std::string name;
  /// The uid that the job must have; empty: any.
  std::string expected_uid = {};
  /// All of its labels; nothing: as before.
  std::optional<JobLabels> labels = {};
  /// Its note; nothing: as before.
  std::optional<std::string> note = {};
};

/// What of a job to read.
enum class JobPart {
  /// All but spec, cycles, groups and final bodies.
  kHeader,
  /// Header and spec.
  kSpec,
  /// Header, spec and checkpoint.
  kRun,
  /// Header, spec, and the result, not parsed: cycles, groups and final bodies.
  kAll,
};

/// A job as it was read.
struct StoredJob {
  v1::Job job;
  /// Grows by 1 each time the job is taken, see JobUpdate::take.
  std::uint64_t epoch = 0;
  /// See Store::RequestCancel.
  bool cancel_requested = false;
  /// See Store::Compact.
  bool compacted = false;
  /// NewJob::request_id; empty without one.
  std::string request_id = {};
  /// The labels of its spec, if that was read. Those of `job` are newer once there was a JobRemark.
  JobLabels created_labels = {};
  /// True if this call of Store::Create made the job.
  bool created = false;
  /// False if the job fails its checksum: then only name, state and sequences of `job` are right.
  bool intact = true;
  /// Checkpoint::state; empty without one, or if it is damaged.
  std::string checkpoint = {};
  /// Sequence of the last event before the checkpoint.
  std::uint64_t checkpoint_sequence = 0;
  /// The result as it is stored; empty if there is none or none was asked for.
  std::string result = {};
  /// Checksum of `result`.
  std::int64_t result_crc32 = 0;

  /// Moves the result into `job`. Parsing a long ledger takes long: not for the store's thread.
  /// Returns false if the result is damaged.
  bool MergeResult();
};

/// Whose a job is.
struct JobOwner {
  std::string owner;
  std::string tenant;
};

/// Which jobs to list.
struct JobQuery {
  /// Jobs of this tenant; nothing: of all, for the server itself.
  std::optional<std::string> tenant = {};
  /// Jobs in one of these states; empty: in any.
  std::vector<int> states = {};
  /// Jobs that have all of these labels.
  JobLabels labels = {};
  /// Jobs whose name begins with this.
  std::string name_prefix = {};
  /// JobPage::next of the page before; 0: from the newest job on.
  std::int64_t before = 0;
  /// Most jobs of the page, > 0.
  int limit = 50;
  /// True once nobody waits for the page: CANCELLED is an answer then, so that ten thousand readers
  /// who leave do not keep the store from its end. Empty: somebody always waits. Called on the
  /// store's thread.
  std::function<bool()> abandoned = {};
};

/// Some of the jobs that a query asks for.
struct JobPage {
  /// Headers, newest job first.
  std::vector<StoredJob> jobs;
  /// JobQuery::before of the next page; 0: there is none.
  std::int64_t next = 0;
};

/// What an ended job takes.
struct JobSize {
  std::string name;
  /// Unix time in seconds; 0 if the job does not tell.
  std::int64_t end_time = 0;
  /// Bytes stored of its events, spec and result.
  std::int64_t bytes = 0;
};

/// Events that one page steps over at most, so that a filter that lets little through does not hold
/// up the commits behind it.
inline constexpr std::uint64_t kMostScanned = 4096;

/// Which events of a job to read.
struct EventQuery {
  std::string name;
  /// Events with a larger sequence.
  std::uint64_t after = 0;
  /// Events of the kinds k whose bit k is set; see KindBit.
  std::uint32_t kinds = ~0U;
  /// About the bytes of a page, decoded. A page has at least one event, however large.
  std::size_t max_bytes = 1 << 18;
  /// As JobQuery::abandoned.
  std::function<bool()> abandoned = {};
};

/// The bit of a kind of event in EventQuery::kinds.
inline std::uint32_t KindBit(v1::Event::PayloadCase kind) { return 1U << kind; }

/// An event as it was read.
struct StoredEvent {
  std::uint64_t sequence = 0;
  v1::Event::PayloadCase kind = v1::Event::PAYLOAD_NOT_SET;
  Coding coding = Coding::kPlain;
  /// As they are stored; empty if not intact.
  std::string bytes;
  /// False if the event fails its checksum.
  bool intact = true;

  /// Decodes the event, which has no sequence. Takes long for a frame chunk: not for the store's
  /// thread. Returns false if the event is damaged.
  bool Parse(v1::Event* event) const { return intact && DecodeEvent(coding, bytes, event); }
  /// As Parse, but gives the serialised message. Leaves no bytes behind.
  bool TakePayload(std::string* payload) {
    return intact && DecodePayload(coding, std::move(bytes), payload);
  }
};

/// Some of the events that a query asks for.
struct EventPage {
  std::vector<StoredEvent> events;
  /// All events asked for up to this sequence have been read: EventQuery::after of the next page.
  std::uint64_t position = 0;
  /// From this sequence on all events are there. Frame chunks before it were dropped.
  std::uint64_t oldest = 1;
};

}  // namespace contact
