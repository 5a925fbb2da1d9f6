#include "wire/rules/field_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;

bool IsDuration(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE &&
         field.message_type()->full_name() == "google.protobuf.Duration";
}

std::string Digits(double value, std::chars_format format) {
  std::array<char, 400> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value, format);
  return {text.data(), result.ptr};
}

// `1e12` instead of `1e+12`, `1e-3` instead of `1e-03`.
std::string Exponential(double value) {
  std::string text = Digits(value, std::chars_format::scientific);
  std::size_t place = text.find('e') + 1;
  if (text[place] == '+') {
    text.erase(place, 1);
  } else {
    ++place;
  }
  if (text[place] == '0') text.erase(place, 1);
  return text;
}

std::string SpanText(double seconds) {
  constexpr double kHour = 3600;
  constexpr double kYear = 366 * 24 * kHour;
  if (seconds == 0) return "0";
  if (seconds < 1) return fmt::format("{} ms", seconds * 1000);
  if (std::fmod(seconds, kYear) == 0) return fmt::format("{} years", seconds / kYear);
  if (std::fmod(seconds, kHour) == 0) return fmt::format("{} h", seconds / kHour);
  return fmt::format("{} s", seconds);
}

// The range of a field without its text.
Range BoundsOf(const FieldDescriptor& field) {
  const v1::FieldRule& rule = RuleOf(field);
  Range range;
  if (rule.low_case() == v1::FieldRule::LOW_NOT_SET) return range;
  range.open = rule.has_above();
  range.low = range.open ? rule.above() : rule.min();
  if (rule.has_max()) range.high = rule.max();
  return range;
}

}  // namespace

const v1::FieldRule& RuleOf(const FieldDescriptor& field) {
  return field.options().GetExtension(v1::rule);
}

std::string NumberText(const FieldDescriptor& field, double value) {
  if (IsDuration(field)) return SpanText(value);
  std::string decimal = Digits(value, std::chars_format::fixed);
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_INT32) return decimal;
  std::string exponential = Exponential(value);
  return exponential.size() < decimal.size() ? exponential : decimal;
}

std::string RangeText(const FieldDescriptor& field) {
  const v1::FieldRule& rule = RuleOf(field);
  if (rule.low_case() == v1::FieldRule::LOW_NOT_SET) return "";
  const std::string low = NumberText(field, rule.has_above() ? rule.above() : rule.min());
  if (!rule.has_max()) return (rule.has_above() ? "> " : "≥ ") + low;
  return fmt::format("{}{}, {}]", rule.has_above() ? "(" : "[", low, NumberText(field, rule.max()));
}

bool Range::Contains(double value) const {
  return std::isfinite(value) && value <= high && (open ? value > low : value >= low);
}

Range RangeOf(const FieldDescriptor& field) {
  Range range = BoundsOf(field);
  if (RuleOf(field).low_case() != v1::FieldRule::LOW_NOT_SET) {
    range.text = (RuleOf(field).has_max() ? "in " : "") + RangeText(field);
  }
  return range;
}

double Seconds(const google::protobuf::Duration& span) {
  return static_cast<double>(span.seconds()) + span.nanos() / 1e9;
}

bool IsInRange(const FieldDescriptor& field, const google::protobuf::Duration& span) {
  return span.nanos() >= 0 && span.nanos() < 1'000'000'000 &&
         BoundsOf(field).Contains(Seconds(span));
}

bool IsNumber(const FieldDescriptor& field) {
  return !field.is_repeated() && (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ||
                                  field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM ||
                                  field.cpp_type() == FieldDescriptor::CPPTYPE_INT32 ||
                                  field.cpp_type() == FieldDescriptor::CPPTYPE_INT64);
}

double NumberIn(const google::protobuf::Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.GetInt32(message, &field);
    case FieldDescriptor::CPPTYPE_INT64:
      return static_cast<double>(reflection.GetInt64(message, &field));
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.GetEnumValue(message, &field);
    default:
      return reflection.GetDouble(message, &field);
  }
}

std::optional<double> NumberField::Find(const google::protobuf::Message& message) const {
  const auto& reflection = *message.GetReflection();
  if (descriptor->has_presence() && !reflection.HasField(message, descriptor)) return std::nullopt;
  return NumberIn(message, *descriptor);
}

std::vector<NumberField> NumbersOf(const google::protobuf::Descriptor& type) {
  std::vector<NumberField> numbers;
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (!IsNumber(field)) continue;
    const auto number = static_cast<std::size_t>(field.number());
    numbers.resize(std::max(numbers.size(), number + 1));
    const v1::FieldRule& rule = RuleOf(field);
    numbers[number] = {&field, RangeOf(field), rule.default_number(), rule.required()};
  }
  return numbers;
}

}  // namespace contact
