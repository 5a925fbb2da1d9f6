#include "cli/text/render_json.h"

#include <fmt/format.h>
#include <google/protobuf/util/json_util.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <cctype>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "base/spelling.h"

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

// True for a whole number that a double holds exactly, as all up to it.
bool IsExact(std::string_view number) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 53;
  if (number.starts_with('-')) number.remove_prefix(1);
  std::uint64_t value = 0;
  const char* const end = number.data() + number.size();
  const auto [rest, error] = std::from_chars(number.data(), end, value);
  return error == std::errc() && rest == end && value <= kMost;
}

bool Has64Bits(const FieldDescriptor* field) {
  return field != nullptr && (field->cpp_type() == FieldDescriptor::CPPTYPE_INT64 ||
                              field->cpp_type() == FieldDescriptor::CPPTYPE_UINT64);
}

// The place after the text that begins at `begin` with a quote.
std::size_t EndOfText(std::string_view json, std::size_t begin) {
  std::size_t end = begin + 1;
  while (json[end] != '"') end += json[end] == '\\' ? 2 : 1;
  return end + 1;
}

// Copies JSON and knows at each place which field's value stands there.
class Copier {
 public:
  explicit Copier(const Descriptor& message) : root_(&message) {}

  std::string Copy(std::string_view json) {
    for (std::size_t at = 0; at < json.size();) {
      if (json[at] == '"') {
        const std::size_t end = EndOfText(json, at);
        AddText(json.substr(at, end - at), json.substr(end).starts_with(':'));
        at = end;
        continue;
      }
      if (json[at] == '{') objects_.push_back({TypeOfNext(), nullptr});
      if (json[at] == '}') objects_.pop_back();
      copy_ += json[at++];
    }
    return std::move(copy_);
  }

 private:
  // An object that has begun.
  struct Object {
    const Descriptor* type;        // Null: its fields are not known.
    const FieldDescriptor* field;  // That was named last; null: not known.
  };

  // The type of the object that begins; null if it is a map or one of google's.
  const Descriptor* TypeOfNext() const {
    if (objects_.empty()) return root_;
    const FieldDescriptor* field = objects_.back().field;
    if (field == nullptr || field->is_map()) return nullptr;
    const Descriptor* type = field->message_type();
    const bool googles = type != nullptr && type->full_name().starts_with("google.protobuf.");
    return googles ? nullptr : type;
  }

  // Adds a text with its quotes: the name of a field, or a value of the last one.
  void AddText(std::string_view text, bool is_name) {
    Object& object = objects_.back();
    const std::string_view inner = text.substr(1, text.size() - 2);
    if (is_name) {
      const std::string name(inner);
      object.field = object.type == nullptr ? nullptr : object.type->FindFieldByName(name);
    }
    const bool plain = !is_name && Has64Bits(object.field) && IsExact(inner);
    copy_ += plain ? inner : text;
  }

  const Descriptor* const root_;
  std::vector<Object> objects_;
  std::string copy_;
};

using Json = nlohmann::ordered_json;

bool IsLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

// True if some reader may take the text without quotes for a number, a flag, a date or null.
bool NeedsQuotes(const std::string& text) {
  constexpr std::array<std::string_view, 11> kWords = {
      "true", "false", "yes", "no", "on", "off", "y", "n", "null", "nan", "infinity"};
  if (text.empty() || !IsLetter(text.front())) return true;
  return std::ranges::find(kWords, boost::to_lower_copy(text)) != kWords.end();
}

// `1e-08` is a text to readers of YAML 1.1, `1.0e-08` is not.
std::string Number(const Json& value) {
  std::string text = value.dump();
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos || text.find('.') != std::string::npos) return text;
  return fmt::format("{}.0{}", text.substr(0, exponent), text.substr(exponent));
}

void Emit(const Json& value, YAML::Emitter* out) {
  if (value.is_object()) {
    *out << (value.empty() ? YAML::Flow : YAML::Block) << YAML::BeginMap;
    for (const auto& [key, entry] : value.items()) {
      *out << YAML::Key;
      Emit(key, out);
      *out << YAML::Value;
      Emit(entry, out);
    }
    *out << YAML::EndMap;
  } else if (value.is_array()) {
    const bool numbers = std::ranges::all_of(value, [](const Json& v) { return v.is_number(); });
    *out << (numbers ? YAML::Flow : YAML::Block) << YAML::BeginSeq;
    for (const Json& entry : value) Emit(entry, out);
    *out << YAML::EndSeq;
  } else if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (Printable(text) != text) *out << YAML::EscapeNonAscii << YAML::DoubleQuoted;
    if (NeedsQuotes(text)) *out << YAML::DoubleQuoted;
    *out << text;
  } else if (value.is_null()) {
    *out << YAML::Null;
  } else if (value.is_number()) {
    *out << Number(value);
  } else {
    *out << value.dump();  // true or false
  }
}

// `whole`: over several lines and with fields that are zero.
std::string Print(const google::protobuf::Message& message, bool whole) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = whole;
  options.add_whitespace = whole;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) throw std::runtime_error("cannot print as JSON: " + status.ToString());
  return EscapedJson(WithPlainNumbers(text, *message.GetDescriptor()));
}

}  // namespace

std::string WithPlainNumbers(std::string_view json, const Descriptor& message) {
  return Copier(message).Copy(json);
}

std::string YamlOfJson(const std::string& json) {
  YAML::Emitter out;
  Emit(Json::parse(json), &out);
  return std::string(out.c_str(), out.size()) + "\n";
}

std::string ToJson(const google::protobuf::Message& message) { return Print(message, true); }

std::string ToJsonLine(const google::protobuf::Message& message) {
  return Print(message, false) + "\n";
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
