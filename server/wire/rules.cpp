#include "wire/rules.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <cmath>
#include <utility>

namespace contact {

bool Range::Contains(double value) const {
  const bool open = text.front() == '(';
  return std::isfinite(value) && value <= high && (open ? value > low : value >= low);
}

void Rules::Break(std::string_view field, std::string description, std::string hint) const {
  if (full()) return;
  violations_->push_back({Path(field), std::move(description), std::move(hint)});
}

void Rules::Require(std::string_view field, double value, const Range& range) const {
  if (full() || range.Contains(value)) return;
  Break(field, fmt::format("is {}; must be in {}", value, range.text));
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
  const std::string message =
      index_ < 0 ? std::string(message_) : fmt::format("{}[{}]", message_, index_);
  return field.empty() ? message : fmt::format("{}.{}", message, field);
}

}  // namespace contact
