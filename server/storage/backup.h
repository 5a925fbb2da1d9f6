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

/// A copy of the store in a file without a name: it is gone when this is.
class BackupFile {
 public:
  /// Takes the file at `path` over and removes its name.
  static absl::StatusOr<std::unique_ptr<BackupFile>> Adopt(const std::filesystem::path& path);

  std::int64_t size() const { return size_; }  ///< In bytes.

  /// The bytes from `offset` on, `most` of them or as many as there are.
  absl::StatusOr<std::string> Read(std::int64_t offset, std::size_t most) const;

 private:
  BackupFile(FileDescriptor file, std::int64_t size) : file_(std::move(file)), size_(size) {}

  const FileDescriptor file_;
  const std::int64_t size_;
};

/// A backup on its way, see Store::Backup. Its file has a name only until it is complete.
class Backup {
 public:
  explicit Backup(std::stop_token stop) : stop_(std::move(stop)) {}
  ~Backup();
  Backup(const Backup&) = delete;
  Backup& operator=(const Backup&) = delete;

  /// Copies some more of the database. False: it is complete. CANCELLED: it was stopped.
  absl::StatusOr<bool> Step(Database& database);

  /// What was copied, once it is complete.
  std::unique_ptr<BackupFile> Take() { return std::move(file_); }

 private:
  const std::stop_token stop_;
  std::filesystem::path draft_;  ///< Empty: there is none.
  std::optional<DatabaseCopy> copy_;
  std::unique_ptr<BackupFile> file_;
};

}  // namespace contact
