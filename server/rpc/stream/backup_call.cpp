#include "rpc/stream/backup_call.h"

#include <utility>

namespace contact {

std::shared_ptr<BackupCall> BackupCall::Make(grpc::CallbackServerContext* context) {
  const std::shared_ptr<BackupCall> call(new BackupCall(context));
  const MutexLock lock(call->mutex_);
  call->self_ = call;
  return call;
}

bool BackupCall::Send(const v1::BackupChunk& chunk, std::chrono::milliseconds stall) {
  const auto end = std::chrono::steady_clock::now() + stall;
  {
    const MutexLock lock(mutex_);
    writing_ = true;
  }
  StartWrite(&chunk);
  const MutexLock lock(mutex_);
  while (writing_) {
    if (taken_.wait_until(mutex_, end) == std::cv_status::no_timeout || !writing_) continue;
    context_->TryCancel();  // Ends the write at once.
    while (writing_) taken_.wait(mutex_);
  }
  return written_;
}

void BackupCall::OnWriteDone(bool ok) {
  const MutexLock lock(mutex_);
  writing_ = false;
  written_ = ok;
  taken_.notify_one();
}

void BackupCall::OnDone() {
  std::shared_ptr<BackupCall> last;  // Goes after the lock.
  const MutexLock lock(mutex_);
  last = std::move(self_);
}

}  // namespace contact
