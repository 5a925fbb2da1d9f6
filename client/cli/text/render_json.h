#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace contact::cli {

/// A message as JSON with the proto's field names and its zeros, over several lines.
std::string ToJson(const google::protobuf::Message& message);

/// The same in one line, without zeros.
std::string ToJsonLine(const google::protobuf::Message& message);

}  // namespace contact::cli
