#include "rpc/admin_service.h"

#include <memory>
#include <utility>

#include "jobs/job/errors.h"
#include "rpc/stream/backup_source.h"

namespace contact {

grpc::ServerWriteReactor<v1::BackupChunk>* AdminService::Backup(
    grpc::CallbackServerContext* context, const v1::BackupRequest* /*request*/) {
  const Call call{"/contact.v1.AdminService/Backup", "", CallKind::kStream};
  return calls_.AuditedStream<v1::BackupChunk>(
      context, call, "backup:", [this](auto wake, auto opened) {
        if (busy_.exchange(true)) return opened(MakeError(Reason::kBackupRunning));
        const std::shared_ptr<const void> busy(this, [this](const void*) { busy_ = false; });
        const auto reader = std::make_shared<BackupReader>(executor_, wake, busy);
        opened(reader->MakeSource());
        store_.Backup(reader->stop_token(),
                      [reader](absl::StatusOr<std::unique_ptr<BackupFile>> file) {
                        reader->Begin(std::move(file));
                      });
      });
}

}  // namespace contact
