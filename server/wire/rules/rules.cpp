#include "wire/rules/rules.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/spelling.h"

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

bool Rules::RequireAtMost(std::string_view field, std::int64_t entries, std::int64_t most) const {
  if (entries > most) Break(field, fmt::format("holds {}; must hold at most {}", entries, most));
  return entries <= most;
}

void Rules::RequireShort(std::string_view field, std::string_view text, int most) const {
  const auto characters = std::ranges::count_if(
      text, [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; });
  if (characters <= most) return;
  Break(field, fmt::format("has {} characters; must have at most {}", characters, most));
}

void Rules::RequirePrintable(std::string_view field, std::string_view text) const {
  if (Printable(text) == text) return;
  Break(field, fmt::format("holds control characters: {}", Quoted(text)), "remove them");
}

void Rules::RequireKnown(std::string_view field, int value,
                         const google::protobuf::EnumDescriptor& type) const {
  if (type.FindValueByNumber(value) != nullptr) return;
  Break(field, fmt::format("is {}, which is no value of {}", value, type.name()));
}

std::string Rules::Path(std::string_view field) const {
  if (message_.empty()) return std::string(field);
  std::string path = parent_ == nullptr ? std::string(message_) : parent_->Path(message_);
  if (index_ >= 0) path += fmt::format("[{}]", index_);
  return field.empty() ? path : fmt::format("{}.{}", path, field);
}

}  // namespace contact
