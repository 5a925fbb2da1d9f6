#include "cli/help/contract/contract.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.pb.h>

#include <sstream>
#include <stdexcept>

#include "base/spelling.h"
#include "wire/rules/field_rule.h"

namespace contact::cli {
namespace {

constexpr char kPackage[] = "contact.v1.";

// True if a line of a comment is not joined with its neighbours: a formula or an entry of a list.
bool StandsAlone(const std::string& line) {
  return line.starts_with(" ") || line.starts_with("* ") || line.starts_with("- ");
}

std::string DefaultText(const google::protobuf::FieldDescriptor& field, const v1::FieldRule& rule) {
  if (rule.has_default_number()) return NumberText(field, rule.default_number());
  return rule.has_default_name() ? rule.default_name() : rule.default_text();
}

// The rules of a field as sentences, each after a space.
std::string RuleText(const google::protobuf::FieldDescriptor& field) {
  const v1::FieldRule& rule = RuleOf(field);
  std::string text;
  const auto add = [&text](const char* word, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {}{}.", word, value);
  };
  add("", rule.required() ? "Required" : "");
  add("Unit: ", rule.unit());
  add("Range: ", RangeText(field));
  add("Default: ", DefaultText(field, rule));
  if (rule.max_characters() > 0)
    text += fmt::format(" At most {}.", Count(rule.max_characters(), "character", "characters"));
  if (rule.min_entries() > 0)
    text += fmt::format(" At least {}.", Count(rule.min_entries(), "entry", "entries"));
  if (rule.max_entries() > 0)
    text += fmt::format(" At most {}.", Count(rule.max_entries(), "entry", "entries"));
  return text;
}

}  // namespace

Contract::Contract() {
  google::protobuf::FileDescriptorSet files;
  const std::span<const unsigned char> bytes = ContractBytes();
  if (!files.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
    throw std::logic_error("the contract in this program is damaged");
  }
  for (const google::protobuf::FileDescriptorProto& file : files.file()) pool_.BuildFile(file);
}

const google::protobuf::Descriptor& Contract::Message(const std::string& name) const {
  const google::protobuf::Descriptor* message = pool_.FindMessageTypeByName(kPackage + name);
  if (message == nullptr) throw std::logic_error("the contract has no message " + name);
  return *message;
}

std::string Unwrap(const std::string& comment) {
  std::istringstream lines(comment);
  std::string text;
  std::string line;
  bool open = false;  // The next line continues the last one of `text`.
  while (std::getline(lines, line)) {
    if (line.starts_with(" ")) line.erase(0, 1);
    const bool alone = StandsAlone(line);
    if (!text.empty()) text += open && !alone && !line.empty() ? " " : "\n";
    text += line;
    open = !alone && !line.empty();
  }
  return text.substr(0, text.find_last_not_of(" \n") + 1);
}

std::string FieldText(const google::protobuf::FieldDescriptor& field) {
  return CommentOf(field) + RuleText(field);
}

std::string ShortTypeName(const google::protobuf::Descriptor& message) {
  const std::string& name = message.full_name();
  return name.starts_with(kPackage) ? name.substr(sizeof(kPackage) - 1) : name;
}

bool IsUnspecified(const google::protobuf::EnumValueDescriptor& value) {
  return value.number() == 0 && value.name().ends_with("_UNSPECIFIED");
}

}  // namespace contact::cli
