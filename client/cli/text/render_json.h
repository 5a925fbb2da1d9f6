#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace contact::cli {

/// A message as JSON over several lines: field names as in the proto, fields that are zero
/// included.
std::string ToJson(const google::protobuf::Message& message);

/// A message as JSON in one line with a line end: field names as in the proto, without fields that
/// are zero.
std::string ToJsonLine(const google::protobuf::Message& message);

}  // namespace contact::cli
