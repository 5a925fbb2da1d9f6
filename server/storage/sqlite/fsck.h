#pragma once

#include <absl/status/statusor.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace contact {

/// What was looked at, and how much of it is not as it should be.
struct FsckReport {
  /// Jobs looked at.
  std::int64_t jobs = 0;
  /// Events looked at; those of removed jobs do not count.
  std::int64_t events = 0;
  /// Lines told. 0: no damage.
  std::int64_t findings = 0;
};

/// Checks everything that is stored in a data directory, without writing anything: the database
/// itself, every checksum, that every log is whole, and that the tables agree. Calls `tell` with
/// one line a finding.
///
/// UNAVAILABLE: another process holds the directory. Other errors: it cannot be looked at at all,
/// for it is missing, no database, or of another schema version.
absl::StatusOr<FsckReport> Fsck(const std::filesystem::path& directory,
                                const std::function<void(const std::string&)>& tell);

}  // namespace contact
