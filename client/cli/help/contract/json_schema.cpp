#include "cli/help/contract/json_schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/input/yaml_reader.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::OneofDescriptor;
using nlohmann::ordered_json;

// Which JSON the schema describes.
enum class Side {
  kWritten,  // By a user: ranges and required fields hold.
  kPrinted,  // By contactctl: unset fields have their zero, NaN may occur.
};

ordered_json Enum(const EnumDescriptor& type, Side side) {
  ordered_json names = ordered_json::array();
  ordered_json meanings = ordered_json::array();
  for (int i = 0; i < type.value_count(); ++i) {
    if (side == Side::kWritten && IsUnspecified(*type.value(i))) continue;
    names.push_back(type.value(i)->name());
    meanings.push_back(CommentOf(*type.value(i)));
  }
  return {{"type", "string"}, {"enum", names}, {"enumDescriptions", meanings}};
}

ordered_json Double(const FieldDescriptor& field, Side side) {
  ordered_json number = {{"type", "number"}};
  if (side == Side::kWritten || !RuleOf(field).may_be_nan()) return number;
  return {{"anyOf", {number, {{"enum", {"NaN", "Infinity", "-Infinity"}}}}}};
}

// A whole number of 64 bits. Those above 2^53 are printed as texts.
ordered_json Printed64Bits() {
  return {{"anyOf", {{{"type", "integer"}}, {{"type", "string"}, {"pattern", "^-?[0-9]+$"}}}}};
}

// The schema, or in a file also a variable in the place of the value.
ordered_json OrVariable(const ordered_json& schema, Side side) {
  if (side == Side::kPrinted) return schema;
  return {{"anyOf", {schema, {{"$ref", "#/definitions/variable"}}}}};
}

void AddBounds(const v1::FieldRule& rule, ordered_json* schema) {
  if (rule.has_min()) (*schema)["minimum"] = rule.min();
  if (rule.has_above()) (*schema)["exclusiveMinimum"] = rule.above();
  if (rule.has_max()) (*schema)["maximum"] = rule.max();
}

// Adds the default of a field unless it is a sentence, which the description has.
void AddDefault(const FieldDescriptor& field, const v1::FieldRule& rule, ordered_json* schema) {
  if (rule.has_default_number()) {
    (*schema)["default"] = rule.default_number();
  } else if (rule.has_default_name() && field.cpp_type() == FieldDescriptor::CPPTYPE_BOOL) {
    (*schema)["default"] = rule.default_name() == "true";
  } else if (rule.has_default_name()) {
    (*schema)["default"] = rule.default_name();
  }
}

void AddCounts(const v1::FieldRule& rule, ordered_json* schema) {
  const int fewest = std::max(rule.min_entries(), rule.required() ? 1 : 0);
  if (fewest > 0) (*schema)["minItems"] = fewest;
  if (rule.max_entries() > 0) (*schema)["maxItems"] = rule.max_entries();
}

// Exactly one field of `oneof`, or at most one where it is not required.
ordered_json OneOf(const OneofDescriptor& oneof) {
  ordered_json choices = ordered_json::array();
  for (int i = 0; i < oneof.field_count(); ++i) {
    choices.push_back({{"required", {oneof.field(i)->name()}}});
  }
  if (!oneof.options().GetExtension(v1::choice_required)) {
    choices.push_back({{"not", {{"anyOf", ordered_json(choices)}}}});
  }
  return {{"oneOf", choices}};
}

// The keys with which a table names a file that contactctl reads its numbers from.
void AddFileKeys(ordered_json* properties) {
  for (const FileKey& key : FileKeys()) {
    const ordered_json type = key.type.empty() ? ordered_json({"string", "integer"})
                                               : ordered_json(std::string(key.type));
    const ordered_json value = {{"type", type}};
    ordered_json& property = (*properties)[std::string(key.name)];
    property = {{"description", key.text}};
    property.update(key.type == "string" || key.type.empty() ? value
                                                             : OrVariable(value, Side::kWritten));
  }
}

// Makes a schema with a definition for each message that it needs.
class Maker {
 public:
  explicit Maker(Side side, bool base_may_be_file) : side_(side), named_base_(base_may_be_file) {}

  // A reference to the definition of `message`, which is made if there is none.
  ordered_json Message(const Descriptor& message) {
    const std::string name = ShortTypeName(message);
    if (message.full_name() == "google.protobuf.Timestamp") {
      return {{"type", "string"}, {"format", "date-time"}};
    }
    if (message.full_name() == "google.protobuf.Any") return {{"type", "object"}};
    if (!definitions_.contains(name)) {
      definitions_[name] = nullptr;  // Stands before the definitions that it needs.
      definitions_[name] = Definition(message);
    }
    return {{"$ref", "#/definitions/" + name}};
  }

  const ordered_json& definitions() const { return definitions_; }

 private:
  ordered_json Definition(const Descriptor& message) {
    ordered_json properties = ordered_json::object();
    ordered_json required = ordered_json::array();
    for (int i = 0; i < message.field_count(); ++i) {
      const FieldDescriptor& field = *message.field(i);
      properties[field.name()] = Property(field);
      if (side_ == Side::kWritten && RuleOf(field).required()) required.push_back(field.name());
    }
    if (side_ == Side::kWritten && TableValues(message) != nullptr) AddFileKeys(&properties);
    ordered_json schema = {{"type", "object"},
                           {"description", CommentOf(message)},
                           {"properties", properties},
                           {"additionalProperties", false}};
    if (!required.empty()) schema["required"] = required;
    for (int i = 0; i < message.real_oneof_decl_count(); ++i) {
      schema["allOf"].push_back(OneOf(*message.oneof_decl(i)));
    }
    return schema;
  }

  ordered_json Property(const FieldDescriptor& field) {
    const v1::FieldRule rule = side_ == Side::kWritten ? RuleOf(field) : v1::FieldRule();
    ordered_json schema = {{"description", FieldText(field)}};
    if (field.is_map()) {
      schema.update({{"type", "object"}, {"additionalProperties", {{"type", "string"}}}});
    } else if (field.is_repeated()) {
      schema.update({{"type", "array"}, {"items", Item(field, rule)}});
      AddCounts(rule, &schema);
    } else if (named_base_ && field.full_name() == "contact.v1.Sweep.base") {
      schema["anyOf"] = {{{"type", "string"}, {"minLength", 1}}, Single(field)};
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      schema["allOf"].push_back(Single(field));  // Validators ignore a description beside $ref.
    } else {
      schema.update(Scalar(field, rule));
      AddDefault(field, rule, &schema);
    }
    return schema;
  }

  ordered_json Scalar(const FieldDescriptor& field, const v1::FieldRule& rule) {
    ordered_json schema = Single(field);
    AddBounds(rule, &schema);
    const bool text = field.cpp_type() == FieldDescriptor::CPPTYPE_STRING;
    if (rule.required() && text) schema["minLength"] = 1;
    if (rule.max_characters() > 0) schema["maxLength"] = rule.max_characters();
    return text ? schema : OrVariable(schema, side_);
  }

  // An entry of a list, whose range is that of each entry.
  ordered_json Item(const FieldDescriptor& field, v1::FieldRule rule) {
    rule.clear_required();
    const bool message = field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
    return message ? Single(field) : Scalar(field, rule);
  }

  ordered_json Single(const FieldDescriptor& field) {
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
        return Double(field, side_);
      case FieldDescriptor::CPPTYPE_INT32:
        return {{"type", "integer"}};
      case FieldDescriptor::CPPTYPE_INT64:
      case FieldDescriptor::CPPTYPE_UINT64:
        if (side_ == Side::kWritten) return {{"type", "integer"}};
        return Printed64Bits();
      case FieldDescriptor::CPPTYPE_BOOL:
        return {{"type", "boolean"}};
      case FieldDescriptor::CPPTYPE_ENUM:
        return Enum(*field.enum_type(), side_);
      case FieldDescriptor::CPPTYPE_MESSAGE:
        return Message(*field.message_type());
      default:
        return {{"type", "string"}};
    }
  }

  const Side side_;
  const bool named_base_;
  ordered_json definitions_ = ordered_json::object();
};

// Lets the message `type`, which is the whole file, have a mapping `variables`.
void AddVariables(const std::string& type, ordered_json* definitions) {
  (*definitions)[type]["properties"]["variables"] = {
      {"description", "Values by name, for ${name} in the file. --var NAME=VALUE gives others."},
      {"type", "object"},
      {"propertyNames", {{"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"}}},
      {"additionalProperties", {{"type", {"number", "string", "boolean"}}}}};
  (*definitions)["variable"] = {{"description", "The value of a variable of the file."},
                                {"type", "string"},
                                {"pattern", "\\$\\{[A-Za-z_][A-Za-z0-9_]*\\}"}};
}

}  // namespace

std::string JsonSchema(const Contract& contract, const std::string& kind) {
  const std::string type = kind == "scenario" ? "Scenario" : kind == "sweep" ? "Sweep" : "Job";
  Maker maker(kind == "job" ? Side::kPrinted : Side::kWritten, kind == "sweep");
  ordered_json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                         {"title", "contactd " + kind}};
  // In an array of its own, because draft-07 ignores every word beside $ref.
  schema["allOf"] = ordered_json::array({maker.Message(contract.Message(type))});
  schema["definitions"] = maker.definitions();
  if (kind != "job") AddVariables(type, &schema["definitions"]);
  return schema.dump(2) + "\n";
}

}  // namespace contact::cli
