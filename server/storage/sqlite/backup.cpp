#include "storage/sqlite/backup.h"

#include <system_error>
#include <utility>

#include "storage/sqlite/database.h"

namespace contact {

Backup::~Backup() {
  copy_.reset();
  std::error_code missing;
  std::filesystem::remove(draft_, missing);
}

absl::StatusOr<bool> Backup::Step(Database& database) {
  if (stop_.stop_requested()) return absl::CancelledError("the backup was stopped");
  if (!copy_) {
    draft_ = database.directory().backup_draft();
    copy_.emplace(database.connection(), draft_);
  }
  if (copy_->Step()) return true;
  auto file = BackupFile::Adopt(draft_);
  if (!file.ok()) return file.status();
  file_ = *std::move(file);
  return false;
}

}  // namespace contact
