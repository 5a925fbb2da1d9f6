#include "cli/help/contract/json_schema.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/input/yaml_reader.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using nlohmann::json;

json SchemaOf(const std::string& kind) { return json::parse(JsonSchema(Contract(), kind)); }

// The schema of the values of a field, without the variable that may stand for them.
json ValuesOf(const json& property) {
  return property.contains("anyOf") ? property["anyOf"][0] : property;
}

// Calls `visit` with each field of the messages that the schema defines, and with its schema.
void ForEachField(const Contract& contract, const json& schema,
                  const std::function<void(const FieldDescriptor&, const json&)>& visit) {
  int fields = 0;
  for (const auto& [name, definition] : schema["definitions"].items()) {
    if (!definition.contains("properties") || name.starts_with("google.")) continue;
    const Descriptor& message = contract.Message(name);
    for (int i = 0; i < message.field_count(); ++i, ++fields) {
      ASSERT_TRUE(definition["properties"].contains(message.field(i)->name()));
      visit(*message.field(i), definition["properties"][message.field(i)->name()]);
    }
  }
  EXPECT_GT(fields, 50);
}

void ForEachObject(const json& value, const std::function<void(const json&)>& visit) {
  if (value.is_object()) visit(value);
  if (!value.is_structured()) return;
  for (const auto& part : value) ForEachObject(part, visit);
}

TEST(JsonSchema, ATableMayBeInAFile) {
  const json tables = SchemaOf("scenario")["definitions"];
  for (const char* name :
       {"Load.Table", "Motion.PositionTable", "Motion.VelocityTable", "Motion.AccelerationTable"}) {
    for (const FileKey& key : FileKeys()) {
      EXPECT_TRUE(tables[name]["properties"].contains(key.name)) << name << " " << key.name;
    }
  }
  EXPECT_FALSE(tables["Load.Sine"]["properties"].contains("file"));
  EXPECT_FALSE(SchemaOf("job")["definitions"]["Load.Table"]["properties"].contains("file"));
}

TEST(JsonSchema, BoundsEqualTheRules) {
  const Contract contract;
  ForEachField(contract, SchemaOf("scenario"), [](const FieldDescriptor& field, const json& made) {
    // The range of a list is that of its entries.
    const json values = ValuesOf(made.contains("items") ? made["items"] : made);
    const v1::FieldRule& rule = RuleOf(field);
    const auto expect = [&](const char* word, bool stated, double bound) {
      EXPECT_EQ(values.contains(word), stated) << field.full_name() << " " << word;
      if (!stated) return;
      EXPECT_EQ(values.value(word, 0.0), bound) << field.full_name() << " " << word;
    };
    expect("minimum", rule.has_min(), rule.min());
    expect("exclusiveMinimum", rule.has_above(), rule.above());
    expect("maximum", rule.has_max(), rule.max());
    expect("maxLength", rule.max_characters() > 0, rule.max_characters());
  });
}

TEST(JsonSchema, NumbersOfEntriesEqualTheRules) {
  const Contract contract;
  ForEachField(contract, SchemaOf("sweep"), [](const FieldDescriptor& field, const json& made) {
    if (!field.is_repeated()) return;
    const v1::FieldRule& rule = RuleOf(field);
    EXPECT_EQ(made.value("maxItems", 0), rule.max_entries()) << field.full_name();
    EXPECT_EQ(made.value("minItems", 0), std::max(rule.min_entries(), rule.required() ? 1 : 0))
        << field.full_name();
  });
}

TEST(JsonSchema, DefaultsEqualTheRules) {
  const Contract contract;
  ForEachField(contract, SchemaOf("scenario"), [](const FieldDescriptor& field, const json& made) {
    const v1::FieldRule& rule = RuleOf(field);
    if (rule.has_default_number()) {
      EXPECT_EQ(made.value("default", -1.0), rule.default_number()) << field.full_name();
    } else if (rule.has_default_name()) {
      const json& value = made["default"];
      EXPECT_EQ(value.is_boolean() ? value.dump() : value.get<std::string>(), rule.default_name());
    } else {
      EXPECT_FALSE(made.contains("default")) << field.full_name();
    }
  });
}

TEST(JsonSchema, FieldsAreRequiredAsTheRulesSay) {
  const Contract contract;
  const json schema = SchemaOf("sweep");
  ForEachField(contract, schema, [&](const FieldDescriptor& field, const json&) {
    const json& definition = schema["definitions"][ShortTypeName(*field.containing_type())];
    const json required = definition.value("required", json::array());
    const bool listed = std::find(required.begin(), required.end(), field.name()) != required.end();
    EXPECT_EQ(listed, RuleOf(field).required()) << field.full_name();
  });
}

TEST(JsonSchema, RequiredChoiceLeavesNoWayWithoutIt) {
  const json schema = SchemaOf("scenario");
  const json& choices = schema["definitions"]["Load"]["allOf"][0]["oneOf"];
  EXPECT_EQ(choices.size(), 7U);  // One for each kind, none for no kind.
  for (const json& choice : choices) EXPECT_TRUE(choice.contains("required"));
}

TEST(JsonSchema, EveryReferenceHasItsDefinition) {
  for (const char* kind : {"scenario", "sweep", "job"}) {
    const json schema = SchemaOf(kind);
    int references = 0;
    ForEachObject(schema, [&](const json& object) {
      if (!object.contains("$ref")) return;
      const std::string name = object["$ref"].get<std::string>().substr(1);
      EXPECT_TRUE(schema.contains(json::json_pointer(name))) << name;
      ++references;
    });
    EXPECT_GT(references, 10) << kind;
  }
}

TEST(JsonSchema, EveryPropertyIsDescribed) {
  for (const char* kind : {"scenario", "sweep", "job"}) {
    const json schema = SchemaOf(kind);
    for (const auto& [name, definition] : schema["definitions"].items()) {
      if (name.starts_with("google.") || !definition.contains("properties")) continue;
      for (const auto& [field, property] : definition["properties"].items()) {
        EXPECT_FALSE(property.value("description", "").empty()) << name << "." << field;
      }
    }
  }
}

TEST(JsonSchema, PrintedJobHasNoBounds) {
  ForEachObject(SchemaOf("job"), [](const json& object) {
    EXPECT_FALSE(object.contains("minimum") && !object["minimum"].is_object()) << object;
    EXPECT_FALSE(object.contains("exclusiveMinimum") && !object["exclusiveMinimum"].is_object());
  });
}

TEST(JsonSchema, PrintedNumbersMayBeNanWhereTheRulesSay) {
  const Contract contract;
  int numbers = 0;
  ForEachField(contract, SchemaOf("job"), [&](const FieldDescriptor& field, const json& made) {
    if (field.cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE || field.is_repeated()) return;
    EXPECT_EQ(made.dump().find("\"NaN\"") != std::string::npos, RuleOf(field).may_be_nan())
        << field.full_name();
    numbers += RuleOf(field).may_be_nan() ? 1 : 0;
  });
  EXPECT_GE(numbers, 3);
}

TEST(JsonSchema, BaseOfASweepMayBeTheNameOfAFile) {
  const json base = SchemaOf("sweep")["definitions"]["Sweep"]["properties"]["base"];
  EXPECT_EQ(base["anyOf"][0]["type"], "string");
  EXPECT_EQ(base["anyOf"][1]["$ref"], "#/definitions/Scenario");
}

TEST(JsonSchema, WrittenEnumsLeaveOutTheValueForNone) {
  const json schema = SchemaOf("scenario");
  const json tension = ValuesOf(schema["definitions"]["Solver"]["properties"]["tension"]);
  EXPECT_EQ(tension["enum"], json({"ALLOW", "CLIP"}));
  EXPECT_EQ(tension["enumDescriptions"].size(), 2U);
}

}  // namespace
}  // namespace contact::cli
