#include "wire/rules/rules.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <optional>
#include <utility>

namespace contact {

void Rules::Break(std::string_view field, std::string description, std::string hint) const {
  if (full()) return;
  violations_->push_back({Path(field), std::move(description), std::move(hint)});
}

void Rules::Require(std::string_view field, double value, const Range& range) const {
  if (full() || range.Contains(value)) return;
  Break(field, fmt::format("is {}; must be {}", value, range.text));
}

double Rules::Read(const google::protobuf::Message& message, const NumberField& number,
                   std::string_view hint) const {
  const std::optional<double> found = number.Find(message);
  const double value = found.value_or(number.default_value);
  if (found ? number.range.Contains(value) : !number.required) return value;
  const std::string& field = number.descriptor->name();
  if (!found) {
    Break(field, "is missing", std::string(hint));
  } else if (value == 0 && number.required) {
    Break(field, fmt::format("is missing; must be {}", number.range.text), std::string(hint));
  } else {
    Require(field, value, number.range);
  }
  return value;
}

void Rules::BreakChoice(std::string_view field, const google::protobuf::EnumDescriptor& descriptor,
                        int value) const {
  const auto* known = descriptor.FindValueByNumber(value);
  if (known == nullptr) {
    Break(field, fmt::format("is {}, which is no value of {}", value, descriptor.name()));
  } else {
    Break(field, fmt::format("{} is not available in this version", known->name()));
  }
}

std::string Rules::Path(std::string_view field) const {
  if (message_.empty()) return std::string(field);
  std::string path = parent_ == nullptr ? std::string(message_) : parent_->Path(message_);
  if (index_ >= 0) path += fmt::format("[{}]", index_);
  return field.empty() ? path : fmt::format("{}.{}", path, field);
}

}  // namespace contact
