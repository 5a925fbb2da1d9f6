#include "rpc/call/status.h"

#include <google/protobuf/util/time_util.h>

#include <cstddef>
#include <string>
#include <vector>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace contact {
namespace {

// Leaves room in the 8 KiB of trailers for the message, which is sent twice, and for base64.
constexpr std::size_t kMaxMessageBytes = 512;
constexpr std::size_t kMaxViolationBytes = 3500;
constexpr std::size_t kMaxDescriptionBytes = 500;

// Cuts between characters: half a character would make the message unreadable to protobuf.
std::string Shorten(const std::string& text, std::size_t max_bytes) {
  if (text.size() <= max_bytes) return text;
  std::size_t end = max_bytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "…";
}

google::rpc::BadRequest Describe(const std::vector<Violation>& violations) {
  google::rpc::BadRequest request;
  for (const Violation& violation : violations) {
    auto* field = request.add_field_violations();
    field->set_field(Shorten(violation.field, kMaxDescriptionBytes));
    field->set_description(Shorten(violation.hint.empty()
                                       ? violation.description
                                       : violation.description + " — " + violation.hint,
                                   kMaxDescriptionBytes));
    if (request.ByteSizeLong() > kMaxViolationBytes && request.field_violations_size() > 1) {
      request.mutable_field_violations()->RemoveLast();
      break;
    }
  }
  return request;
}

google::rpc::ErrorInfo Info(const Error& error, std::size_t violations_left_out) {
  google::rpc::ErrorInfo info;
  info.set_domain("contact");
  info.set_reason(error.reason);
  info.mutable_metadata()->insert(error.metadata.begin(), error.metadata.end());
  if (violations_left_out > 0) {
    (*info.mutable_metadata())[std::string("violations_left_out")] =
        std::to_string(violations_left_out);
  }
  return info;
}

google::rpc::ResourceInfo Missing(const Error& error) {
  google::rpc::ResourceInfo resource;
  resource.set_resource_type("contact.v1.Job");
  if (const auto name = error.metadata.find("name"); name != error.metadata.end()) {
    resource.set_resource_name(name->second);
  }
  resource.set_description(error.message);
  return resource;
}

google::rpc::QuotaFailure Failure(const Error& error) {
  google::rpc::QuotaFailure failure;
  google::rpc::QuotaFailure::Violation& violation = *failure.add_violations();
  violation.set_subject("principal:" + error.metadata.at("principal"));
  violation.set_description(error.message);
  return failure;
}

google::rpc::RetryInfo Retry(std::chrono::milliseconds delay) {
  using google::protobuf::util::TimeUtil;
  google::rpc::RetryInfo retry;
  *retry.mutable_retry_delay() = TimeUtil::MillisecondsToDuration(delay.count());
  return retry;
}

}  // namespace

grpc::Status ToGrpc(const Error& error) {
  google::rpc::Status status;
  status.set_code(static_cast<int>(error.code));  // absl, gRPC and google.rpc share the numbers.
  status.set_message(Shorten(error.message, kMaxMessageBytes));

  const google::rpc::BadRequest request = Describe(error.violations);
  const std::size_t listed = static_cast<std::size_t>(request.field_violations_size());
  status.add_details()->PackFrom(Info(error, error.violations.size() - listed));
  if (listed > 0) status.add_details()->PackFrom(request);
  if (error.code == absl::StatusCode::kNotFound) status.add_details()->PackFrom(Missing(error));
  if (error.reason == InfoOf(Reason::kQuotaExceeded).name) {
    status.add_details()->PackFrom(Failure(error));
  }
  if (error.retry_after.count() > 0) status.add_details()->PackFrom(Retry(error.retry_after));

  return {static_cast<grpc::StatusCode>(error.code), status.message(), status.SerializeAsString()};
}

}  // namespace contact
