#include "storage/rows.h"

#include <utility>

#include "storage/changes.h"
#include "storage/checksum.h"
#include "storage/job_parts.h"
#include "storage/refusals.h"

namespace contact {
namespace {

// Gives the job the labels and the note of remarks. False: one fails its checksum.
bool AddRemarks(const JobColumns& columns, v1::Job* job) {
  if (columns.labels_crc32 != kNoRemark) {
    v1::Job said;
    if (!Passes(columns.labels_crc32, columns.labels, columns.name)) return false;
    if (!said.ParseFromString(columns.labels)) return false;
    job->mutable_labels()->swap(*said.mutable_labels());
  }
  if (columns.note_crc32 == kNoRemark) return true;
  job->set_note(columns.note);
  return Passes(columns.note_crc32, columns.note, columns.name);
}

}  // namespace

StoredJob ToStored(const JobColumns& columns) {
  StoredJob stored;
  v1::Job& job = stored.job;
  stored.intact = columns.sealed && Checksum(columns.header) == columns.crc32 &&
                  job.ParseFromString(columns.header) && job.name() == columns.name &&
                  OwnerOf(job) == columns.owner && TenantOf(job) == columns.tenant &&
                  AddRemarks(columns, &job);
  if (!stored.intact) job.Clear();
  job.set_name(columns.name);
  job.set_owner(columns.owner);
  job.set_tenant(columns.tenant);
  job.set_state(static_cast<v1::Job::State>(columns.state));
  stored.epoch = columns.epoch;
  stored.cancel_requested = columns.cancel_requested;
  stored.compacted = columns.compacted;
  stored.request_id = RequestIdOf(columns.request_key, columns.tenant);
  job.set_oldest_sequence(columns.oldest_sequence);
  job.set_last_sequence(columns.last_sequence);
  return stored;
}

StoredEvent ToStored(std::uint64_t sequence, int kind, CodedEvent event, std::int64_t crc32,
                     std::uint64_t place, const std::string& job) {
  StoredEvent stored;
  stored.sequence = sequence;
  stored.kind = static_cast<v1::Event::PayloadCase>(kind);
  stored.intact = Passes(crc32, event, place, job);
  if (!stored.intact) return stored;
  stored.coding = event.coding;
  stored.bytes = std::move(event.bytes);
  return stored;
}

void MergeSpec(const std::string& bytes, std::int64_t crc32, StoredJob* stored) {
  v1::Job& job = stored->job;
  const auto newest = std::exchange(*job.mutable_labels(), {});
  stored->intact = stored->intact && Passes(crc32, bytes, job.name()) && job.MergeFromString(bytes);
  stored->created_labels.insert(job.labels().begin(), job.labels().end());
  *job.mutable_labels() = newest;
}

void AddCheckpoint(std::string state, std::int64_t crc32, std::uint64_t sequence,
                   StoredJob* stored) {
  if (!Passes(crc32, state, stored->job.name())) return;
  stored->checkpoint = std::move(state);
  stored->checkpoint_sequence = sequence;
}

absl::StatusOr<StoredJob> IfIntact(StoredJob stored) {
  if (!stored.intact) return FailsChecksum(stored.job.name());
  return stored;
}

bool StoredJob::MergeResult() {
  const std::string bytes = std::exchange(result, {});
  return bytes.empty() || (Passes(result_crc32, bytes, job.name()) && job.MergeFromString(bytes));
}

}  // namespace contact
