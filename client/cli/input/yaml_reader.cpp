#include "cli/input/yaml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/spelling.h"
#include "cli/base/scalar.h"
#include "cli/input/yaml_document.h"
#include "wire/rules/field_path.h"

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::OneofDescriptor;

// How a value of the wrong type is called.
std::string Shown(const YAML::Node& node) {
  if (node.IsMap()) return "a mapping";
  if (node.IsSequence()) return "a list";
  if (node.IsNull()) return "nothing";
  return Quoted(node.Scalar());
}

std::string EnumName(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) {
    return c == '-' ? '_' : static_cast<char>(std::toupper(c));
  });
  return text;
}

constexpr std::array<FileKey, 8> kKeys{
    {{"file", "string",
      "A file of rows of numbers, as loggers write it, from the folder of this file. It takes the "
      "place of the points."},
     {"column", "",
      "The column of the values, by its header or its number from 1. Default: the first but that "
      "of the times."},
     {"unit", "string", "Unit of the values. Default: that of the header, or else the SI unit."},
     {"scale", "number", "What the values are multiplied with. Default: 1."},
     {"time_column", "",
      "The column of the times, by its header or its number from 1. Default: that called time or "
      "t, or else the first."},
     {"time_unit", "string", "Unit of the times. Default: that of the header, or else s."},
     {"shift_s", "number", "What is added to the times, in s. Default: 0."},
     {"skip", "integer",
      "Lines of the file before its headers. Default: found by where rows of numbers begin."}}};

constexpr char kPoint[] = "decimals are written with a point";

bool IsDigits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// The last entry of a mapping, if its value may be what stands before a decimal comma: YAML takes
// `{stiffness: 1,0e8}` for two entries, the second with the key `0e8` and no value.
struct Whole {
  YAML::Mark mark;
  std::string path;
  std::string digits;  // The value with its sign; empty: it is no whole number.
  bool told = false;   // Whether a decimal comma after it was reported.
};

Whole WholeOf(const YAML::Node& value, std::string path) {
  if (!value.IsScalar()) return {};
  std::string_view digits = value.Scalar();
  if (digits.starts_with('-') || digits.starts_with('+')) digits.remove_prefix(1);
  return {value.Mark(), std::move(path), IsDigits(digits) ? value.Scalar() : std::string()};
}

// Whether an entry is what stands after a decimal comma, such as `5` or `0e8`.
bool AreDecimals(const YAML::Node& key, const YAML::Node& value) {
  const std::string& text = key.Scalar();
  return value.IsNull() && IsDigits(text.substr(0, text.find_first_of("eE"))) &&
         ParseNumber(text).has_value();
}

// The field of the same oneof that is set already; null if there is none.
const FieldDescriptor* Rival(const FieldDescriptor& field, const Message& message) {
  const OneofDescriptor* oneof = field.real_containing_oneof();
  if (oneof == nullptr) return nullptr;
  return message.GetReflection()->GetOneofFieldDescriptor(message, oneof);
}

// Stores a value in a field that is single or a list.
template <class Value, class Set, class Add>
void Store(const FieldDescriptor& field, Message* message, Value value, Set set, Add add) {
  const auto* reflection = message->GetReflection();
  if (field.is_repeated()) {
    (reflection->*add)(message, &field, std::move(value));
  } else {
    (reflection->*set)(message, &field, std::move(value));
  }
}

}  // namespace

std::vector<std::string> EnumWords(const EnumDescriptor& type) {
  std::vector<std::string> words;
  for (int i = 0; i < type.value_count(); ++i) {
    if (type.value(i)->number() != 0) words.push_back(type.value(i)->name());
  }
  return words;
}

const EnumValueDescriptor* FindWord(const EnumDescriptor& type, const std::string& text) {
  return type.FindValueByName(EnumName(text));
}

std::span<const FileKey> FileKeys() { return kKeys; }

const FieldDescriptor* TableValues(const Descriptor& type) {
  if (type.FindFieldByName("times_s") == nullptr) return nullptr;
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    const bool numbers = field.is_repeated() && field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE;
    if (numbers && field.name() != "times_s") return &field;
  }
  return nullptr;
}

void YamlReader::ReadMessage(const YAML::Node& node, const std::string& path,
                             Message* message) const {
  if (node.IsNull()) return;
  if (!node.IsMap()) return Refuse(node, path, "a mapping");
  const bool in_file = IsInFile(node, *message->GetDescriptor());
  std::map<std::string, int> lines;
  Whole before;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) {
      Refuse(entry.first, path, "the name of a field");
      continue;
    }
    const std::string& name = entry.first.Scalar();
    if (!before.digits.empty() && AreDecimals(entry.first, entry.second)) {
      if (std::exchange(before.told, true)) continue;  // Thousands, as in 1,000,000.
      report_(before.mark, before.path,
              fmt::format("expected a number, got {}", Quoted(before.digits + "," + name)), kPoint);
      continue;
    }
    before = WholeOf(entry.second, JoinPath(path, name));
    const auto [first, is_new] = lines.emplace(name, entry.first.Mark().line + 1);
    if (is_new && in_file) {
      ReadEntryBesideFile(entry.first, entry.second, path, message);
    } else if (is_new) {
      ReadEntry(entry.first, entry.second, path, message);
    } else {
      report_(entry.first.Mark(), JoinPath(path, name),
              fmt::format("is given twice, first in line {}", first->second), "");
    }
  }
  if (in_file) read_file_(node, path, message);
}

bool YamlReader::IsInFile(const YAML::Node& node, const Descriptor& type) const {
  if (!read_file_ || TableValues(type) == nullptr) return false;
  return std::any_of(node.begin(), node.end(), [](const auto& entry) {
    return entry.first.IsScalar() && entry.first.Scalar() == FileKeys().front().name;
  });
}

void YamlReader::ReadEntryBesideFile(const YAML::Node& key, const YAML::Node& value,
                                     const std::string& path, Message* message) const {
  std::vector<std::string_view> keys;
  for (const FileKey& known : FileKeys()) keys.push_back(known.name);
  const std::string& name = key.Scalar();
  if (std::ranges::find(keys, name) != keys.end()) return;
  const FieldDescriptor* field = message->GetDescriptor()->FindFieldByName(name);
  if (field != nullptr && !field->is_repeated()) return ReadEntry(key, value, path, message);
  report_(key.Mark(), JoinPath(path, name),
          field == nullptr ? "unknown field" : "cannot stand beside file",
          field == nullptr
              ? DidYouMean(name, keys, fmt::format("fields are {}", fmt::join(keys, ", ")))
              : "");
}

void YamlReader::ReadEntry(const YAML::Node& key, const YAML::Node& value, const std::string& path,
                           Message* message) const {
  const Descriptor& type = *message->GetDescriptor();
  const FieldDescriptor* field = type.FindFieldByName(key.Scalar());
  if (field == nullptr) {
    const std::string name = key.Scalar().size() > 64 ? Quoted(key.Scalar()) : key.Scalar();
    report_(key.Mark(), JoinPath(path, name), "unknown field", FieldHint(type, key.Scalar()));
    return;
  }
  const FieldDescriptor* rival = Rival(*field, *message);
  if (rival != nullptr) {
    report_(key.Mark(), JoinPath(path, field->name()),
            fmt::format("cannot stand beside {}", rival->name()), "make an entry of each");
    return;
  }
  ReadField(value, JoinPath(path, field->name()), *field, message);
}

void YamlReader::ReadField(const YAML::Node& node, const std::string& path,
                           const FieldDescriptor& field, Message* message) const {
  const auto* reflection = message->GetReflection();
  if (field.is_repeated()) {
    reflection->ClearField(message, &field);
    ReadList(node, path, field, message);
  } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
    reflection->ClearField(message, &field);
    ReadMessage(node, path, reflection->MutableMessage(message, &field));
  } else if (!node.IsNull()) {
    ReadScalar(node, path, field, message);
  }
}

void YamlReader::ReadList(const YAML::Node& node, const std::string& path,
                          const FieldDescriptor& field, Message* message) const {
  if (node.IsNull()) return;
  if (!node.IsSequence()) return Refuse(node, path, "a list");
  int index = 0;
  for (const auto& item : node) {
    const std::string item_path = fmt::format("{}[{}]", path, index++);
    if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      ReadMessage(item, item_path, message->GetReflection()->AddMessage(message, &field));
    } else {
      ReadScalar(item, item_path, field, message);
    }
  }
}

void YamlReader::ReadScalar(const YAML::Node& node, const std::string& path,
                            const FieldDescriptor& field, Message* message) const {
  using google::protobuf::Reflection;
  const std::string text = node.IsScalar() ? node.Scalar() : std::string();
  const auto store = [&](const auto& value, const char* expected, auto set, auto add) {
    const bool comma =
        field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE && text.find(',') != std::string::npos;
    if (!value) return Refuse(node, path, expected, comma ? kPoint : "");
    Store(field, message, *value, set, add);
  };
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return store(ParseNumber(text), "a number", &Reflection::SetDouble, &Reflection::AddDouble);
    case FieldDescriptor::CPPTYPE_INT32:
      return store(ParseInteger<std::int32_t>(text), "a whole number", &Reflection::SetInt32,
                   &Reflection::AddInt32);
    case FieldDescriptor::CPPTYPE_INT64:
      return store(ParseInteger<std::int64_t>(text), "a whole number", &Reflection::SetInt64,
                   &Reflection::AddInt64);
    case FieldDescriptor::CPPTYPE_BOOL:
      return store(ParseBool(text), "true or false", &Reflection::SetBool, &Reflection::AddBool);
    case FieldDescriptor::CPPTYPE_STRING:
      if (!IsUtf8(text)) return report_(node.Mark(), path, "is not in UTF-8", "");
      return store(node.IsScalar() ? std::optional(text) : std::nullopt, "a text",
                   &Reflection::SetString, &Reflection::AddString);
    case FieldDescriptor::CPPTYPE_ENUM:
      return ReadEnum(node, path, field, message);
    default:
      throw std::logic_error("the scenario has no field of this type: " + field.full_name());
  }
}

void YamlReader::ReadEnum(const YAML::Node& node, const std::string& path,
                          const FieldDescriptor& field, Message* message) const {
  const EnumDescriptor& type = *field.enum_type();
  const std::vector<std::string> words = EnumWords(type);
  const std::string all = fmt::format("one of {}", fmt::join(words, ", "));
  if (!node.IsScalar()) return Refuse(node, path, all);
  const EnumValueDescriptor* value = FindWord(type, node.Scalar());
  if (value != nullptr) {
    return Store(field, message, value->number(), &google::protobuf::Reflection::SetEnumValue,
                 &google::protobuf::Reflection::AddEnumValue);
  }
  const std::string_view nearest = Nearest(EnumName(node.Scalar()), {words.begin(), words.end()});
  report_(node.Mark(), path, fmt::format("unknown value {}", Quoted(node.Scalar())),
          nearest.empty() ? all : fmt::format("did you mean {}? {}", nearest, all));
}

void YamlReader::Refuse(const YAML::Node& node, const std::string& path,
                        const std::string& expected, const std::string& hint) const {
  const bool variable = node.IsScalar() && node.Scalar().find("${") != std::string::npos;
  report_(node.Mark(), path, fmt::format("expected {}, got {}", expected, Shown(node)),
          variable ? "give it a value below variables:" : hint);
}

}  // namespace contact::cli
