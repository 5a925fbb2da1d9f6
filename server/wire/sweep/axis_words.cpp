#include "wire/sweep/axis_words.h"

#include <cmath>

#include "wire/rules/field_path.h"

namespace contact {

const google::protobuf::FieldDescriptor* FieldAt(std::string_view path) {
  const google::protobuf::Descriptor* message = v1::Scenario::descriptor();
  const google::protobuf::FieldDescriptor* field = nullptr;
  for (const PathStep& step : ParsePath(path, true)) {
    field = message == nullptr ? nullptr : message->FindFieldByName(step.name);
    if (field == nullptr) return nullptr;
    message = field->message_type();
  }
  return field;
}

const std::string& AxisName(const v1::Sweep::Axis& axis) {
  return axis.label().empty() ? axis.field() : axis.label();
}

std::string_view AxisWord(const v1::Sweep::Axis& axis, double value) {
  constexpr double kMost = 1e6;  // More than any enum has.
  const auto* field = std::abs(value) < kMost ? FieldAt(axis.field()) : nullptr;
  if (field == nullptr || field->enum_type() == nullptr) return {};
  const auto* word = field->enum_type()->FindValueByNumber(static_cast<int>(std::lround(value)));
  return word == nullptr ? std::string_view() : std::string_view(word->name());
}

}  // namespace contact
