#include "cli/help/contract/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <sstream>

#include "cli/input/scenario_file.h"
#include "cli/input/templates.h"
#include "cli/input/yaml_reader.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

std::string SingleType(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return "number";
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_INT64:
      return "whole number";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_ENUM:
      return "word";
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return ShortTypeName(*field.message_type());
    default:
      return "text";
  }
}

Term FieldTerm(const FieldDescriptor& field) {
  const std::string single = SingleType(field);
  Term term{field.name(), field.is_repeated() ? "list of " + single : single, FieldText(field), {}};
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_ENUM) return term;
  for (int i = 0; i < field.enum_type()->value_count(); ++i) {
    const auto& value = *field.enum_type()->value(i);
    if (!IsUnspecified(value)) term.values.push_back({value.name(), "", CommentOf(value), {}});
  }
  return term;
}

// What the reference says about a choice between fields.
std::string ChoiceText(const google::protobuf::OneofDescriptor& choice) {
  std::vector<std::string> names;
  for (int i = 0; i < choice.field_count(); ++i) {
    names.push_back(fmt::format("`{}`", choice.field(i)->name()));
  }
  const bool required = choice.options().GetExtension(v1::choice_required);
  return fmt::format("\n\n{} one of {}. {}", required ? "Exactly" : "At most",
                     fmt::join(names, ", "), CommentOf(choice));
}

// Adds the chapter of a message, then those of the messages in its fields that are not `seen`.
void Walk(const Descriptor& message, std::set<const Descriptor*>* seen,
          std::vector<Chapter>* chapters) {
  if (!seen->insert(&message).second) return;
  Chapter chapter{ShortTypeName(message), CommentOf(message), {}};
  for (int i = 0; i < message.real_oneof_decl_count(); ++i) {
    chapter.text += ChoiceText(*message.oneof_decl(i));
  }
  for (int i = 0; i < message.field_count(); ++i) {
    chapter.fields.push_back(FieldTerm(*message.field(i)));
  }
  chapters->push_back(std::move(chapter));
  for (int i = 0; i < message.field_count(); ++i) {
    if (message.field(i)->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
    Walk(*message.field(i)->message_type(), seen, chapters);
  }
}

// Escapes stars outside of code, because Markdown takes them for emphasis.
std::string Escape(std::string_view text) {
  std::string escaped;
  bool code = false;
  for (const char c : text) {
    if (c == '`') code = !code;
    if (c == '*' && !code) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

// Text as Markdown, each line after `indent`. Indented lines become code.
std::string Paragraphs(const std::string& text, const std::string& indent) {
  std::istringstream lines(text);
  std::string page;
  std::string line;
  bool code = false;
  while (std::getline(lines, line)) {
    if (line.starts_with(" ") != code) page += "\n";
    code = line.starts_with(" ");
    if (!line.empty()) page += fmt::format("{}{}", indent, code ? "  " + line : Escape(line));
    page += "\n";
  }
  return page;
}

std::string InMarkdown(const Term& field) {
  std::string page = fmt::format("- `{}` ({}): {}\n", field.name, field.type, Escape(field.text));
  for (const Term& value : field.values) {
    page += fmt::format("  - `{}`: {}\n", value.name, Escape(value.text));
  }
  return page;
}

constexpr char kVariables[] = R"(
## Variables

A file may begin with `variables`, names and their values; `${name}` in any value below stands for the
value, also within a text. In braces or brackets it needs quotes. `$${` is `${` itself. contactctl and the
Python client put the values in; what the server gets has none.

```yaml
variables: {restitution: 0.8, height_m: 1.0}
title: Dropped from ${height_m} m
bodies:
  - {name: ball, mass_kg: 0.5, radius_m: 0.05, position_m: "${height_m}"}
```

`run`, `submit`, `validate` and `sweep run` take other values: `--var restitution=0.7`. Of a sweep file
whose base is a file, each has its own variables; `--var` is for that which has the name.

An axis of a sweep may be a variable, `var:restitution`: it sets every number whose value is `${restitution}`.
)";

std::string TablesInFiles() {
  std::string page = R"(
## Tables in files

A table of a load or motion may be in a file of its own, such as a logger writes: `file` takes the place of
`points`, or of `times_s` and the values. contactctl and the Python client read the file; what the server gets is
the numbers. Nothing is resampled. [The guide](../docs/guide/scenarios.md#measured-loads-and-motions) shows it.

```yaml
loads:
  - body: ram
    table: {file: hammer.csv, column: force, unit: kN, shift_s: 0.01}
```

)";
  for (const FileKey& key : FileKeys()) {
    const std::string_view type = key.type.empty()        ? "text or whole number"
                                  : key.type == "integer" ? "whole number"
                                  : key.type == "string"  ? "text"
                                                          : "number";
    page += fmt::format("- `{}` ({}): {}\n", key.name, type, key.text);
  }
  return page;
}

std::string Shipped() {
  std::string page = "| File | Shows |\n|---|---|\n";
  for (const Template& scenario : Templates()) {
    page += fmt::format("| [{0}.yaml]({0}.yaml) | {1} |\n", scenario.name, scenario.shows);
  }
  return page;
}

}  // namespace

std::vector<Chapter> ScenarioReference(const Contract& contract) {
  std::vector<Chapter> chapters;
  std::set<const Descriptor*> seen;
  Walk(contract.Message("Scenario"), &seen, &chapters);
  Walk(contract.Message("Sweep"), &seen, &chapters);
  return chapters;
}

std::string ReferenceInMarkdown(const std::vector<Chapter>& chapters) {
  std::string page =
      "<!-- Made by `contactctl schema --markdown` from proto/contact/v1/scenario.proto. -->\n\n"
      "# Scenarios\n\n" +
      Shipped() +
      "\nA scenario file is one `Scenario`, a sweep file one `Sweep`, in YAML or JSON. What may "
      "stand in\nthem follows. An editor that knows JSON Schema completes and checks it: see the "
      "first line of each\nfile, and `contactctl schema`.\n";
  page += kVariables;
  page += TablesInFiles();
  for (const Chapter& chapter : chapters) {
    page += fmt::format("\n## {}\n\n{}", chapter.name, Paragraphs(chapter.text, ""));
    page += chapter.fields.empty() ? "" : "\n";
    for (const Term& field : chapter.fields) page += InMarkdown(field);
  }
  return page;
}

}  // namespace contact::cli
