#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "base/clock.h"
#include "contact/v1/job.pb.h"
#include "identity/audit_log.h"
#include "jobs/job/errors.h"
#include "rpc/call/call_guard.h"

namespace contact {

/// What a service tells of a call before it starts.
struct Call {
  /// As in the table of methods.
  const char* method;
  /// Name of the job that the call is about; may be empty.
  std::string job = {};
  CallKind kind = CallKind::kUnary;
};

/// What the audit log is told of one call: that it was refused for who makes it, or, of a call that
/// changes something, how it ended. Copyable.
class Audit {
 public:
  /// `log` may be null: then nothing is told. The clock outlives it.
  Audit(std::shared_ptr<AuditLog> log, const Clock& clock, const grpc::ServerContextBase& context,
        const Call& call, const Admission& admission);

  /// The call has ended with this result.
  template <class T>
  void End(const Result<T>& result) const {
    if (!log_) return;
    Write(result.ok() ? nullptr : &result.error(), result.ok() ? NameOf(result.value()) : "");
  }

  /// Writes that the call begins, and calls `begin`. False: that could not be written.
  void Begin(const std::function<void(bool)>& begin) const;

 private:
  static std::string NameOf(const v1::Job& job) { return job.name(); }
  template <class T>
  static std::string NameOf(const T& /*result*/) {
    return "";
  }
  /// Writes the end of the call, if the log is to have it. `error` may be null.
  void Write(const Error* error, const std::string& job) const;

  std::shared_ptr<AuditLog> log_;
  const Clock* clock_;
  /// True if the call changes something.
  bool mutation_ = false;
  /// Without the end of the call.
  AuditRecord record_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace contact
