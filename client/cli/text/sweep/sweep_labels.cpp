#include "cli/text/sweep/sweep_labels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <google/protobuf/descriptor.h>

#include <boost/algorithm/string/replace.hpp>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "wire/column_name.h"
#include "wire/rules/field_path.h"

namespace contact::cli {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;

std::string Words(std::string_view name) {
  return boost::replace_all_copy(std::string(name), "_", " ");
}

// The fields of a path, one for each step; none if the contract does not have one.
std::vector<const FieldDescriptor*> FieldsOf(const std::vector<PathStep>& path,
                                             const Descriptor* type) {
  std::vector<const FieldDescriptor*> fields;
  for (const PathStep& step : path) {
    const FieldDescriptor* field = type == nullptr ? nullptr : type->FindFieldByName(step.name);
    if (field == nullptr) return {};
    fields.push_back(field);
    type = field->message_type();
  }
  return fields;
}

// Whole numbers and words have no unit.
std::string_view UnitOf(const FieldDescriptor& field) {
  const bool real = field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE;
  return real ? ColumnOf(field).unit : std::string_view();
}

// Restitution goes in and out, but not out of a contact.
std::string_view Link(std::string_view quantity) {
  return quantity.ends_with(" in") || quantity.ends_with(" out") ? ", " : " of ";
}

// `before`, what the path says without its entry, and whose it is: `wall position of ball-wall
// [m]`.
std::string Label(const std::vector<PathStep>& path, const Descriptor& type,
                  std::vector<std::string> before,
                  const std::function<std::string(const PathStep&)>& owner_of) {
  const std::vector<const FieldDescriptor*> fields = FieldsOf(path, &type);
  if (fields.empty()) return "";
  std::string owner;  // The innermost entry first.
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i].index || !path[i].key.empty()) {
      owner = fmt::format("{}{}{}", owner_of(path[i]), owner.empty() ? "" : " of ", owner);
    } else if (i + 1 < path.size()) {
      before.push_back(Words(path[i].name));
    }
  }
  before.push_back(Words(ColumnOf(*fields.back()).name));
  std::string label = fmt::format("{}", fmt::join(before, " "));
  if (!owner.empty()) label += fmt::format("{}{}", Link(label), owner);
  return ColumnHeader(label, UnitOf(*fields.back()));
}

std::string NameOf(const v1::Contact& contact) {
  if (!contact.name().empty()) return contact.name();
  return fmt::format("{}{}", fmt::join(contact.between(), "-"), contact.has_wall() ? "-wall" : "");
}

// Whose the entry of a scenario's list is.
std::string OwnerIn(const v1::Scenario& base, const PathStep& step) {
  if (!step.key.empty()) return step.key;
  if (step.index == PathStep::kEvery) return fmt::format("all {}", step.name);
  const int i = *step.index;
  std::string entry = fmt::format("{}[{}]", step.name, i);
  if (step.name == "bodies" && i < base.bodies_size()) return base.bodies(i).name();
  if (step.name == "contacts" && i < base.contacts_size()) return NameOf(base.contacts(i));
  if (step.name == "loads" && i < base.loads_size()) return entry + " on " + base.loads(i).body();
  return entry;
}

std::string OwnerIn(const PathStep& step) {
  return step.key.empty() ? fmt::format("{}[{}]", step.name, *step.index) : step.key;
}

}  // namespace

std::string AxisLabel(const v1::Sweep& sweep, int axis) {
  const v1::Sweep::Axis& varied = sweep.axes(axis);
  if (!varied.label().empty()) return varied.label();
  const auto owner = [&](const PathStep& step) { return OwnerIn(sweep.base(), step); };
  const std::string label =
      Label(ParsePath(varied.field(), true), *v1::Scenario::descriptor(), {}, owner);
  return label.empty() ? varied.field() : label;
}

std::string MetricLabel(const std::string& metric) {
  std::vector<PathStep> path = ParsePath(metric, true);
  if (path.empty()) return metric;
  const auto owner = [](const PathStep& step) { return OwnerIn(step); };
  const auto label = [&](const Descriptor& type, std::vector<std::string> before) {
    return Label(path, type, std::move(before), owner);
  };
  std::vector<std::string> before;
  if (path.front().name == "final_bodies") before = {"final"};
  if (path.front().name == "groups") before = {"group"};
  if (path.front().name == "summary") path.erase(path.begin());
  for (const Descriptor* type : {v1::RunSummary::descriptor(), v1::Job::descriptor()}) {
    if (std::string text = label(*type, before); !text.empty()) return text;
  }
  return metric;
}

}  // namespace contact::cli
