#include "cli/text/render_json.h"

#include <google/protobuf/util/json_util.h>

#include <stdexcept>

#include "cli/text/plain_numbers.h"

namespace contact::cli {
namespace {

std::string Print(const google::protobuf::Message& message,
                  const google::protobuf::util::JsonPrintOptions& options) {
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) throw std::runtime_error("cannot print as JSON: " + status.ToString());
  return WithPlainNumbers(text, *message.GetDescriptor());
}

}  // namespace

std::string ToJson(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  options.add_whitespace = true;
  return Print(message, options);
}

std::string ToJsonLine(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  return Print(message, options) + "\n";
}

}  // namespace contact::cli
