#pragma once

#include <google/protobuf/descriptor.h>
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

/// A JSON document as YAML, its fields in the same order. Readers of YAML 1.1 and 1.2 read the same
/// values as a reader of JSON: a text that looks like a value of another type is in quotes. Throws
/// nlohmann::json::exception if `json` is no JSON.
std::string YamlOfJson(const std::string& json);

/// `json`, in which protobuf has printed a message of this type, without the quotes that it puts
/// around whole numbers of 64 bits, so that programs need not convert them. A number above 2^53,
/// which not every reader holds exactly, keeps them, as do numbers in maps and in google's types.
std::string WithPlainNumbers(std::string_view json, const google::protobuf::Descriptor& message);

}  // namespace contact::cli
