#include "cli/input/settable_fields.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>

#include "cli/input/yaml_reader.h"
#include "wire/scenario/entry_names.h"

namespace contact::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

constexpr int kMostEntries = 20;  // Of a list one by one.

std::vector<std::string> Words(const FieldDescriptor& field) {
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) return {"true", "false"};
  const bool is_enum = field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM;
  return is_enum ? EnumWords(*field.enum_type()) : std::vector<std::string>();
}

void AddFields(const Message& message, const std::string& prefix,
               std::vector<SettableField>* fields);

void AddEntries(const Message& message, const FieldDescriptor& field, const std::string& path,
                std::vector<SettableField>* fields) {
  const auto& reflection = *message.GetReflection();
  const int size = reflection.FieldSize(message, &field);
  for (int i = 0; i < std::min(size, kMostEntries); ++i) {
    const Message& entry = reflection.GetRepeatedMessage(message, &field, i);
    AddFields(entry, fmt::format("{}[{}].", path, i), fields);
    const std::string name = NameOfEntry(message, field, i);
    if (!name.empty()) AddFields(entry, fmt::format("{}[{}].", path, name), fields);
  }
  const Message& typical =
      size > 0 ? reflection.GetRepeatedMessage(message, &field, 0)
               : *reflection.GetMessageFactory()->GetPrototype(field.message_type());
  AddFields(typical, path + "[*].", fields);
}

void AddFields(const Message& message, const std::string& prefix,
               std::vector<SettableField>* fields) {
  const auto& reflection = *message.GetReflection();
  const auto& type = *message.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    const std::string path = prefix + field.name();
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
      fields->push_back({path, Words(field)});
    } else if (field.is_repeated()) {
      AddEntries(message, field, path, fields);
    } else if (prefix.empty() || reflection.HasField(message, &field)) {  // solver and output.
      AddFields(reflection.GetMessage(message, &field), path + ".", fields);
    }
  }
}

}  // namespace

std::vector<SettableField> SettableFields(const v1::Scenario& scenario) {
  std::vector<SettableField> fields;
  AddFields(scenario, "", &fields);
  return fields;
}

}  // namespace contact::cli
