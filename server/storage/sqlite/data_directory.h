#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <filesystem>

#include "base/file_descriptor.h"

namespace contact {

/// The next step for whoever may not read or write a file, to stand at the end of a sentence.
inline constexpr char kGiveAccess[] =
    "; run contactd as the user who owns it, or give this one the right to read and write";

/// The folder that holds all that survives a restart, locked for this process.
///
/// The lock is an open-file-description lock: the kernel drops it when the process dies, however
/// that happens. Files: README.md.
class DataDirectory {
 public:
  /// Creates the folder if it is missing and locks it. UNAVAILABLE if another process holds it.
  /// FAILED_PRECONDITION if it cannot be made or written, or if others may write into it.
  static absl::StatusOr<DataDirectory> Open(const std::filesystem::path& path);

  /// Locks it against processes that change it, without changing anything: for those that only
  /// read. UNAVAILABLE if another process holds it. NOT_FOUND: there is no such folder.
  static absl::StatusOr<DataDirectory> OpenToRead(const std::filesystem::path& path);

  /// File of the database.
  std::filesystem::path database() const { return path_ / "contactd.db"; }

  /// Space that is given up when the disk is full, see Reserve.
  std::filesystem::path reserve() const { return path_ / "reserve"; }

  /// Where a backup is made before it is sent. Removed at the next Open if a crash leaves it.
  std::filesystem::path backup_draft() const { return path_ / "backup.tmp"; }

  /// True once MarkInitialised succeeded: from then on a missing database is a loss.
  bool initialised() const;
  /// Marks the directory as one in use, on disk. FAILED_PRECONDITION: it cannot be written.
  absl::Status MarkInitialised() const;

 private:
  DataDirectory(std::filesystem::path path, FileDescriptor lock)
      : path_(std::move(path)), lock_(std::move(lock)) {}

  std::filesystem::path path_;
  // The lock file, which is locked while this is open; none for a reader of an unused directory.
  FileDescriptor lock_;
};

}  // namespace contact
