#include "gateway/protocol/codes.h"

#include <array>
#include <nlohmann/json.hpp>

#include "gateway/protocol/codec.h"
#include "gateway/protocol/frames.h"
#include "google/rpc/status.pb.h"

namespace contact::gateway {
namespace {

using Json = nlohmann::json;

struct Code {
  const char* name;
  int http;
};

// By the number of the code.
constexpr std::array kCodes = std::to_array<Code>({
    {"ok", 200},
    {"canceled", 499},
    {"unknown", 500},
    {"invalid_argument", 400},
    {"deadline_exceeded", 504},
    {"not_found", 404},
    {"already_exists", 409},
    {"permission_denied", 403},
    {"resource_exhausted", 429},
    {"failed_precondition", 400},
    {"aborted", 409},
    {"out_of_range", 400},
    {"unimplemented", 501},
    {"internal", 500},
    {"unavailable", 503},
    {"data_loss", 500},
    {"unauthenticated", 401},
});

const Code& Find(grpc::StatusCode code) {
  const auto index = static_cast<std::size_t>(code);
  return kCodes.at(index < kCodes.size() ? index : std::size_t{grpc::StatusCode::UNKNOWN});
}

Json Detail(const google::protobuf::Any& any) {
  const std::string& url = any.type_url();
  const std::string type = url.substr(url.rfind('/') + 1);
  Json detail = {{"type", type}, {"value", ToBase64(any.value())}};
  const auto* known =
      google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(type);
  std::string text;
  if (known == nullptr || !ToJson(*known, any.value(), &text).ok()) return detail;
  Json debug = Json::parse(text, nullptr, false);
  if (!debug.is_discarded()) detail["debug"] = std::move(debug);
  return detail;
}

}  // namespace

const char* ConnectCode(grpc::StatusCode code) { return Find(code).name; }

int HttpStatus(grpc::StatusCode code) { return Find(code).http; }

std::string ErrorJson(const grpc::Status& error) {
  Json object = {{"code", ConnectCode(error.error_code())}};
  if (!error.error_message().empty()) object["message"] = error.error_message();
  google::rpc::Status status;
  if (status.ParseFromString(error.error_details())) {
    for (const auto& any : status.details()) object["details"].push_back(Detail(any));
  }
  return object.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace contact::gateway
