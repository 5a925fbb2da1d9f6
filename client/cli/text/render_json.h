#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

namespace contact::cli {

/// A message as JSON over several lines: field names as in the proto, fields that are zero
/// included. Numbers are those of WithPlainNumbers.
std::string ToJson(const google::protobuf::Message& message);

/// The same in one line with a line end, without fields that are zero.
std::string ToJsonLine(const google::protobuf::Message& message);

/// JSON with the escape for each character that steers a terminal, which printers of JSON leave.
std::string EscapedJson(std::string_view json);

}  // namespace contact::cli
