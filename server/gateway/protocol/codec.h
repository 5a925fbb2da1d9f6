#pragma once

#include <google/protobuf/descriptor.h>
#include <grpcpp/support/status.h>

#include <string>
#include <string_view>

namespace contact::gateway {

/// The method of a path such as `/contact.v1.JobService/GetJob`; null if the contract has none.
const google::protobuf::MethodDescriptor* FindMethod(std::string_view path);

/// True if the contract says that the method changes nothing, so that it may be a GET.
bool HasNoSideEffects(const google::protobuf::MethodDescriptor& method);

/// The bytes of a message as protobuf's JSON. Otherwise an error, INTERNAL: they are no such
/// message, or one without JSON. `type` is of the contract.
grpc::Status ToJson(const google::protobuf::Descriptor& type, const std::string& bytes,
                    std::string* json);

/// The bytes of a message in JSON. Otherwise an error, INVALID_ARGUMENT (FIELD_INVALID), which
/// names the place.
grpc::Status FromJson(const google::protobuf::Descriptor& type, const std::string& json,
                      std::string* bytes);

}  // namespace contact::gateway
