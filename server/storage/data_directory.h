#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <filesystem>

namespace contact {

/// The folder that holds all that survives a restart, locked for this process.
///
/// The lock is an open-file-description lock: the kernel drops it when the process dies, however
/// that happens. Files: README.md.
class DataDirectory {
 public:
  /// Creates the folder if it is missing and locks it. UNAVAILABLE if another process holds it.
  static absl::StatusOr<DataDirectory> Open(const std::filesystem::path& path);

  DataDirectory(DataDirectory&& other) noexcept;
  DataDirectory& operator=(DataDirectory&& other) = delete;
  ~DataDirectory();

  std::filesystem::path database() const { return path_ / "contactd.db"; }

  /// True once MarkInitialised succeeded: from then on a missing database is a loss.
  bool initialised() const;
  absl::Status MarkInitialised() const;

 private:
  DataDirectory(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}

  std::filesystem::path path_;
  int lock_;  ///< Descriptor that holds the lock.
};

}  // namespace contact
