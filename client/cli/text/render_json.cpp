#include "cli/text/render_json.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "base/spelling.h"
#include "cli/text/plain_numbers.h"

namespace contact::cli {
namespace {

std::string Print(const google::protobuf::Message& message,
                  const google::protobuf::util::JsonPrintOptions& options) {
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) throw std::runtime_error("cannot print as JSON: " + status.ToString());
  return EscapedJson(WithPlainNumbers(text, *message.GetDescriptor()));
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

std::string EscapedJson(std::string_view json) {
  std::string text;
  while (!json.empty()) {
    const std::size_t bytes = json.front() == '\n' ? 0 : UnprintableBytes(json);
    if (bytes == 0) {
      text += json.front();
    } else {
      unsigned code =
          static_cast<unsigned char>(json[0]) & (bytes == 1 ? 0x7FU : 0x3FU >> (bytes - 1));
      for (const char c : json.substr(1, bytes - 1))
        code = code << 6U | (static_cast<unsigned char>(c) & 0x3FU);
      text += fmt::format("\\u{:04x}", code);
    }
    json.remove_prefix(std::max<std::size_t>(1, bytes));
  }
  return text;
}

}  // namespace contact::cli
