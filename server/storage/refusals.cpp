#include "storage/refusals.h"

#include <absl/strings/cord.h>
#include <absl/strings/str_cat.h>

#include "base/spelling.h"

namespace contact {

absl::Status NoSuchJob(const std::string& name) {
  return absl::NotFoundError(absl::StrCat("there is no job ", Shortened(name)));
}

absl::Status FailsChecksum(const std::string& name) {
  return absl::DataLossError(absl::StrCat(name, " fails its checksum in the store"));
}

absl::Status OtherJob(const v1::Job& job) {
  absl::Status status =
      absl::AbortedError(absl::StrCat(job.name(), " is another job than the one expected"));
  status.SetPayload(kUidPayload, absl::Cord(job.uid()));
  return status;
}

absl::Status HasOtherOwner(const std::string& name) {
  return absl::AbortedError(absl::StrCat(name, " has another owner, or has ended"));
}

absl::Status HasNotEnded(const std::string& name) {
  return absl::FailedPreconditionError(absl::StrCat(name, " has not ended"));
}

absl::Status RequestIdWasUsed(const std::string& name) {
  return absl::AlreadyExistsError(absl::StrCat("request_id was used with another job, ", name));
}

absl::Status MayNotBeNew() { return absl::ResourceExhaustedError("the job is new"); }

absl::Status TooMuch(const char* payload, std::int64_t has) {
  absl::Status status = absl::ResourceExhaustedError("there is too much for one job more");
  status.SetPayload(payload, absl::Cord(absl::StrCat(has)));
  return status;
}

}  // namespace contact
