#include "rpc/admin_service.h"

#include <chrono>
#include <memory>
#include <utility>

#include "rpc/stream/backup_source.h"

namespace contact {
namespace {

Error BackupRunning() {
  return {.code = absl::StatusCode::kResourceExhausted,
          .reason = "BACKUP_RUNNING",
          .message = "another backup is being made",
          .retry_after = std::chrono::seconds{1}};
}

}  // namespace

grpc::ServerWriteReactor<v1::BackupChunk>* AdminService::Backup(
    grpc::CallbackServerContext* context, const v1::BackupRequest* /*request*/) {
  return calls_.Stream<v1::BackupChunk>(context, "backup:", [this](auto wake, auto opened) {
    if (busy_.exchange(true)) return opened(BackupRunning());
    const std::shared_ptr<const void> busy(this, [this](const void*) { busy_ = false; });
    const auto reader = std::make_shared<BackupReader>(executor_, wake, busy);
    opened(reader->MakeSource());
    jobs_.Backup(reader->stop_token(), [reader](Result<std::shared_ptr<BackupFile>> file) {
      reader->Begin(std::move(file));
    });
  });
}

}  // namespace contact
