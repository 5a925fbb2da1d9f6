#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

namespace contact::cli {

/// `json`, in which protobuf has printed a message of this type, without the quotes that it puts
/// around whole numbers of 64 bits, so that programs need not convert them. A number above 2^53,
/// which not every reader holds exactly, keeps them, as do numbers in maps and in google's types.
std::string WithPlainNumbers(std::string_view json, const google::protobuf::Descriptor& message);

}  // namespace contact::cli
