#include "storage/rows.h"

#include <utility>

#include "storage/changes.h"
#include "storage/checksum.h"
#include "storage/job_parts.h"
#include "storage/refusals.h"

namespace contact {

StoredJob ToStored(const JobColumns& columns) {
  StoredJob stored;
  v1::Job& job = stored.job;
  stored.intact = columns.sealed && Checksum(columns.header) == columns.crc32 &&
                  job.ParseFromString(columns.header) && job.name() == columns.name &&
                  OwnerOf(job) == columns.owner && TenantOf(job) == columns.tenant;
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

void MergePart(const std::string& bytes, std::int64_t crc32, StoredJob* stored) {
  stored->intact = stored->intact && Passes(crc32, bytes, stored->job.name()) &&
                   stored->job.MergeFromString(bytes);
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
