#pragma once

#include <absl/status/status.h>
#include <absl/status/statusor.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "base/file_descriptor.h"
#include "storage/database_copy.h"

namespace contact {

class Database;

/// A copy of the store in a file without a name: the file is gone when this is. Safe to read from
/// any thread.
class BackupFile {
 public:
  /// Opens the file at `path` and removes its name. UNAVAILABLE: the disk failed.
  static absl::StatusOr<std::unique_ptr<BackupFile>> Adopt(const std::filesystem::path& path);

  /// In bytes.
  std::int64_t size() const { return size_; }

  /// The bytes from `offset` on, `most` of them or as many as there are. `offset` is at most
  /// size(). UNAVAILABLE: the disk failed, or the file is shorter than it was.
  absl::StatusOr<std::string> Read(std::int64_t offset, std::size_t most) const;

 private:
  BackupFile(FileDescriptor file, std::int64_t size) : file_(std::move(file)), size_(size) {}

  const FileDescriptor file_;
  const std::int64_t size_;
};

/// A backup that is being made, see Store::Backup. Its file has a name only until it is complete.
/// Belongs to the store's thread.
class Backup {
 public:
  /// `stop`: the next step gives up once a stop is requested.
  explicit Backup(std::stop_token stop) : stop_(std::move(stop)) {}
  /// Removes the file of a backup that is not complete.
  ~Backup();
  Backup(const Backup&) = delete;
  Backup& operator=(const Backup&) = delete;

  /// Copies some more of the database. Returns false once the backup is complete. CANCELLED: a stop
  /// was requested.
  absl::StatusOr<bool> Step(Database& database);

  /// The copy, once it is complete; null before.
  std::unique_ptr<BackupFile> Take() { return std::move(file_); }

 private:
  const std::stop_token stop_;
  // Where the copy is made; empty before the first step.
  std::filesystem::path draft_;
  // Present while the copy is made.
  std::optional<DatabaseCopy> copy_;
  std::unique_ptr<BackupFile> file_;
};

}  // namespace contact
