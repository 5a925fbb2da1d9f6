#include "gateway/protocol/codec.h"

#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver.h>
#include <google/protobuf/util/type_resolver_util.h>

#include <algorithm>
#include <memory>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace contact::gateway {
namespace {

namespace util = google::protobuf::util;

constexpr char kPrefix[] = "type.googleapis.com";

// Knows the messages of the contract.
util::TypeResolver* Resolver() {
  static const std::unique_ptr<util::TypeResolver> resolver(util::NewTypeResolverForDescriptorPool(
      kPrefix, google::protobuf::DescriptorPool::generated_pool()));
  return resolver.get();
}

std::string UrlOf(const std::string& type) { return std::string(kPrefix) + "/" + type; }

// The error of a request that breaks rules of the contract, as of native calls.
grpc::Status FieldInvalid(const std::string& words) {
  google::rpc::ErrorInfo info;
  info.set_domain("contact");
  info.set_reason("FIELD_INVALID");
  google::rpc::Status status;
  status.set_code(grpc::StatusCode::INVALID_ARGUMENT);
  status.set_message(words);
  status.add_details()->PackFrom(info);
  return {grpc::StatusCode::INVALID_ARGUMENT, words, status.SerializeAsString()};
}

}  // namespace

const google::protobuf::MethodDescriptor* FindMethod(std::string_view path) {
  if (path.size() < 2 || path.front() != '/' || std::ranges::count(path, '/') != 2) return nullptr;
  std::string name(path.substr(1));
  if (name.find('.') == std::string::npos) return nullptr;
  std::ranges::replace(name, '/', '.');
  return google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(name);
}

bool HasNoSideEffects(const google::protobuf::MethodDescriptor& method) {
  return method.options().idempotency_level() == google::protobuf::MethodOptions::NO_SIDE_EFFECTS;
}

std::optional<std::string> ToJson(const std::string& type, const std::string& bytes) {
  std::string json;
  const auto status = util::BinaryToJsonString(Resolver(), UrlOf(type), bytes, &json);
  if (!status.ok()) return std::nullopt;
  return json;
}

grpc::Status FromJson(const std::string& type, const std::string& json, std::string* bytes) {
  const auto status = util::JsonToBinaryString(Resolver(), UrlOf(type), json, bytes);
  if (status.ok()) return grpc::Status::OK;
  std::string words(status.message());
  // It may quote what is not UTF-8.
  std::ranges::replace_if(
      words, [](char c) { return static_cast<unsigned char>(c) > '~'; }, '?');
  return FieldInvalid(words);
}

}  // namespace contact::gateway
