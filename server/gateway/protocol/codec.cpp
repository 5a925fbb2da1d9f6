#include "gateway/protocol/codec.h"

#include <google/protobuf/arena.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/message.h>
#include <google/protobuf/type.pb.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver.h>
#include <google/protobuf/util/type_resolver_util.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "base/mutex.h"
#include "gateway/protocol/json_print.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "jobs/job/errors.h"

namespace contact::gateway {
namespace {

namespace pb = google::protobuf;
namespace util = google::protobuf::util;

constexpr char kPrefix[] = "type.googleapis.com";

// Knows the messages of the contract. protobuf asks for each type in each conversion, and makes it
// of its descriptor anew, which takes most of the time; this one keeps them. Thread-safe.
class Types final : public util::TypeResolver {
 public:
  util::Status ResolveMessageType(const std::string& url, pb::Type* type) override {
    return Resolve(url, type, messages_, &util::TypeResolver::ResolveMessageType);
  }
  util::Status ResolveEnumType(const std::string& url, pb::Enum* type) override {
    return Resolve(url, type, enums_, &util::TypeResolver::ResolveEnumType);
  }

 private:
  template <class Type>
  struct Known {
    Mutex mutex;
    std::map<std::string, Type> types ABSL_GUARDED_BY(mutex);
  };

  template <class Type>
  util::Status Resolve(const std::string& url, Type* type, Known<Type>& known,
                       util::Status (util::TypeResolver::*make)(const std::string&, Type*)) {
    const MutexLock lock(known.mutex);
    auto found = known.types.find(url);
    if (found == known.types.end()) {
      Type made;
      if (auto status = (descriptors_.get()->*make)(url, &made); !status.ok()) return status;
      DropOptions(&made);
      found = known.types.emplace(url, std::move(made)).first;
    }
    *type = found->second;
    return {};
  }

  // The rules of fields, for which JSON has no use.
  static void DropOptions(pb::Type* type) {
    for (pb::Field& field : *type->mutable_fields()) field.clear_options();
  }
  static void DropOptions(pb::Enum* type) {
    for (pb::EnumValue& value : *type->mutable_enumvalue()) value.clear_options();
  }

  const std::unique_ptr<util::TypeResolver> descriptors_{
      util::NewTypeResolverForDescriptorPool(kPrefix, pb::DescriptorPool::generated_pool())};
  Known<pb::Type> messages_;
  Known<pb::Enum> enums_;
};

util::TypeResolver* Resolver() {
  static Types types;
  return &types;
}

std::string UrlOf(const pb::Descriptor& type) {
  return std::string(kPrefix) + "/" + type.full_name();
}

// The error of a request that breaks rules of the contract, as of native calls.
grpc::Status FieldInvalid(const std::string& words) {
  google::rpc::ErrorInfo info;
  info.set_domain("contact");
  info.set_reason(InfoOf(Reason::kFieldInvalid).name);
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

grpc::Status ToJson(const pb::Descriptor& type, const std::string& bytes, std::string* json) {
  pb::Arena arena;
  pb::Message* message = pb::MessageFactory::generated_factory()->GetPrototype(&type)->New(&arena);
  auto printed = message->ParseFromString(bytes) ? PrintJson(*message) : std::nullopt;
  if (!printed) return {grpc::StatusCode::INTERNAL, "the answer has no JSON"};
  *json = *std::move(printed);
  return grpc::Status::OK;
}

grpc::Status FromJson(const pb::Descriptor& type, const std::string& json, std::string* bytes) {
  const auto status = util::JsonToBinaryString(Resolver(), UrlOf(type), json, bytes);
  if (status.ok()) return grpc::Status::OK;
  std::string words(status.message());
  // It may quote what is not UTF-8.
  std::ranges::replace_if(
      words, [](char c) { return static_cast<unsigned char>(c) > '~'; }, '?');
  return FieldInvalid(words);
}

}  // namespace contact::gateway
