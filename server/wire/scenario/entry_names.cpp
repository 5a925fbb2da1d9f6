#include "wire/scenario/entry_names.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <string_view>
#include <vector>

#include "base/spelling.h"
#include "contact/v1/scenario.pb.h"
#include "wire/scenario/contact_codec.h"

namespace contact {
namespace {

NamedEntry NoEntry(const char* what, const std::string& name,
                   const std::vector<std::string>& names) {
  return {.problem = fmt::format("there is no {} {}", what, Quoted(name)),
          .hint = DidYouMean(name, {names.begin(), names.end()})};
}

NamedEntry FindBody(const v1::Scenario& scenario, const std::string& name) {
  for (int i = 0; i < scenario.bodies_size(); ++i) {
    if (scenario.bodies(i).name() == name) return {.index = i};
  }
  std::vector<std::string> names;
  for (const v1::Body& body : scenario.bodies()) names.push_back(body.name());
  return NoEntry("body", name, names);
}

// True if the contact `number` of an entry has this name, which is not that of the entry.
bool IsNamed(const v1::Contact& entry, int number, const std::string& name) {
  // Lists of contacts are long: no name is made that need not be.
  if (entry.name().empty() && !name.starts_with(entry.between(number - 1))) return false;
  return ContactName(entry, number) == name;
}

NamedEntry FoundContact(const v1::Contact& entry, int index, const std::string& name) {
  if (ContactsOf(entry) == 1) return {.index = index};
  return {.problem = fmt::format("{} has its fields in common with the other contacts of "
                                 "contacts[{}]",
                                 Quoted(name), index),
          .hint = fmt::format("contacts[{}] sets them for all", index)};
}

std::vector<std::string> ContactNames(const v1::Scenario& scenario) {
  std::vector<std::string> names;
  for (const v1::Contact& entry : scenario.contacts()) {
    for (int number = 1; number <= ContactsOf(entry); ++number) {
      names.push_back(ContactName(entry, number));
    }
  }
  return names;
}

NamedEntry FindContact(const v1::Scenario& scenario, const std::string& name) {
  for (int i = 0; i < scenario.contacts_size(); ++i) {
    const v1::Contact& entry = scenario.contacts(i);
    if (entry.name() == name) return {.index = i};
    for (int number = 1; number <= ContactsOf(entry); ++number) {
      if (IsNamed(entry, number, name)) return FoundContact(entry, i, name);
    }
  }
  return NoEntry("contact", name, ContactNames(scenario));
}

}  // namespace

NamedEntry FindNamed(const google::protobuf::Message& message,
                     const google::protobuf::FieldDescriptor& list, const std::string& name) {
  if (message.GetDescriptor() == v1::Scenario::descriptor()) {
    const auto& scenario = static_cast<const v1::Scenario&>(message);
    if (list.number() == v1::Scenario::kBodiesFieldNumber) return FindBody(scenario, name);
    if (list.number() == v1::Scenario::kContactsFieldNumber) return FindContact(scenario, name);
  }
  return {.problem = "its entries have no names", .hint = "give an index, or [*] for every entry"};
}

std::string NameOfEntry(const google::protobuf::Message& message,
                        const google::protobuf::FieldDescriptor& list, int index) {
  if (message.GetDescriptor() != v1::Scenario::descriptor()) return "";
  const auto& scenario = static_cast<const v1::Scenario&>(message);
  if (list.number() == v1::Scenario::kBodiesFieldNumber) return scenario.bodies(index).name();
  if (list.number() != v1::Scenario::kContactsFieldNumber) return "";
  const v1::Contact& entry = scenario.contacts(index);
  return entry.name().empty() && ContactsOf(entry) == 1 ? ContactName(entry, 1) : entry.name();
}

}  // namespace contact
