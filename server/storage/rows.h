#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <string>

#include "storage/records.h"

namespace contact {

/// Checksum of labels or a note that nobody has given in a JobRemark.
inline constexpr std::int64_t kNoRemark = -1;

/// What an engine reads of a row of jobs. Columns: README.md.
struct JobColumns {
  std::string name;
  int state = 0;
  std::uint64_t epoch = 0;
  bool cancel_requested = false;
  std::uint64_t last_sequence = 0;
  std::int64_t crc32 = 0;
  std::string header;
  std::uint64_t oldest_sequence = 1;
  bool compacted = false;
  std::string owner;
  std::string tenant;
  /// JobInsert::request_key; empty without one.
  std::string request_key = {};
  /// Labels and note of the newest JobRemarks, each with its checksum or kNoRemark.
  std::int64_t labels_crc32 = kNoRemark;
  std::string labels = {};
  std::int64_t note_crc32 = kNoRemark;
  std::string note = {};
  /// False: other columns of the row fail the engine's own checksum.
  bool sealed = true;
};

/// The job of a row, checked: not intact if the header fails its checksum or says something else
/// than the row, or if a remark fails its own.
StoredJob ToStored(const JobColumns& columns);

/// An event of a row of the job; `crc32` is that of Checksum(event, place, job).
StoredEvent ToStored(std::uint64_t sequence, int kind, CodedEvent event, std::int64_t crc32,
                     std::uint64_t place, const std::string& job);

/// Adds the spec of the job, but for its labels, if it passes its checksum; else the job is not
/// intact.
void MergeSpec(const std::string& bytes, std::int64_t crc32, StoredJob* stored);

/// Adds the checkpoint, if it passes its checksum.
void AddCheckpoint(std::string state, std::int64_t crc32, std::uint64_t sequence,
                   StoredJob* stored);

/// The job, or DATA_LOSS if it is not intact.
absl::StatusOr<StoredJob> IfIntact(StoredJob stored);

}  // namespace contact
