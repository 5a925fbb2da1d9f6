#include "rpc/call/audit.h"

#include <utility>

#include "base/ids.h"
#include "identity/permissions.h"

namespace contact {
namespace {

// A name that the server gave has 15 characters; others are cut.
constexpr std::size_t kMostOfName = 64;

}  // namespace

Audit::Audit(std::shared_ptr<AuditLog> log, const Clock& clock,
             const grpc::ServerContextBase& context, const Call& call, const Admission& admission)
    : log_(std::move(log)), clock_(&clock) {
  if (!log_) return;
  const MethodRule* rule = FindMethod(call.method);
  mutation_ = rule != nullptr && rule->mutation;
  begin_ = clock_->Elapsed();
  record_ = {.time = clock_->Now(),
             .call = RandomIds().NextId(),
             .caller = admission.caller,
             .peer = CallerUri(context),
             .method = call.method,
             .job = call.job.substr(0, kMostOfName),
             .code = {},
             .reason = {}};
}

void Audit::Begin(const std::function<void(bool)>& begin) const {
  if (!log_) return begin(true);
  AuditRecord record = record_;
  record.code = "STARTED";
  log_->WriteDurably(std::move(record), begin);
}

void Audit::Write(const Error* error, const std::string& job) const {
  const bool refused = error != nullptr && (error->code == absl::StatusCode::kUnauthenticated ||
                                            error->code == absl::StatusCode::kPermissionDenied ||
                                            error->reason == InfoOf(Reason::kQuotaExceeded).name);
  if (!mutation_ && !refused) return;
  AuditRecord record = record_;
  const absl::StatusCode code = error == nullptr ? absl::StatusCode::kOk : error->code;
  record.code = absl::StatusCodeToString(code);
  if (error != nullptr) record.reason = error->reason;
  if (!job.empty()) record.job = job;
  record.duration =
      std::chrono::duration_cast<std::chrono::microseconds>(clock_->Elapsed() - begin_);
  log_->Write(std::move(record));
}

}  // namespace contact
