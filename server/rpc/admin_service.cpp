#include "rpc/admin_service.h"

#include <cstdint>
#include <future>
#include <utility>

#include "base/digest.h"
#include "jobs/job/job_errors.h"
#include "rpc/call/status.h"
#include "rpc/stream/backup_call.h"
#include "storage/backup.h"

namespace contact {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{256} * 1024;

grpc::Status Busy() {
  return ToGrpc({.code = absl::StatusCode::kResourceExhausted,
                 .reason = "BACKUP_RUNNING",
                 .message = "another backup is being made",
                 .retry_after = std::chrono::seconds{1}});
}

grpc::Status SendFile(const BackupFile& file, BackupCall& call, std::chrono::milliseconds stall) {
  Sha256 digest;
  for (std::int64_t offset = 0; offset < file.size();) {
    absl::StatusOr<std::string> bytes = file.Read(offset, kChunkBytes);
    if (!bytes.ok()) return ToGrpc(ToError(bytes.status(), ""));
    v1::BackupChunk chunk;
    chunk.set_offset(offset);
    chunk.set_crc32c(Crc32c(*bytes));
    digest.Add(*bytes);
    offset += static_cast<std::int64_t>(bytes->size());
    chunk.set_data(*std::move(bytes));
    if (offset == file.size()) {
      chunk.set_total_bytes(offset);
      chunk.set_sha256(digest.Finish());
    }
    if (!call.Send(chunk, stall)) return grpc::Status::CANCELLED;
  }
  return grpc::Status::OK;
}

}  // namespace

grpc::ServerWriteReactor<v1::BackupChunk>* AdminService::Backup(
    grpc::CallbackServerContext* context, const v1::BackupRequest* /*request*/) {
  auto call = BackupCall::Make(context);
  BackupCall* const reactor = call.get();
  if (busy_.exchange(true)) {
    call->End(Busy());
    return reactor;
  }
  executor_.Post([this, call = std::move(call)] {
    const grpc::Status status = Serve(*call);
    busy_ = false;  // Before the client, who may call again at once, learns of the end.
    call->End(status);
  });
  return reactor;
}

grpc::Status AdminService::Serve(BackupCall& call) {
  std::promise<Result<std::shared_ptr<BackupFile>>> promise;
  jobs_.Backup(call.gone(), [&promise](Result<std::shared_ptr<BackupFile>> result) {
    promise.set_value(std::move(result));
  });
  const auto file = promise.get_future().get();
  if (!file.ok()) return ToGrpc(file.error());
  return SendFile(*file.value(), call, write_stall_);
}

}  // namespace contact
