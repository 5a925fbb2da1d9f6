#pragma once

#include <absl/status/statusor.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>

#include "storage/backup_file.h"
#include "storage/sqlite/database_copy.h"

namespace contact {

class Database;

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
