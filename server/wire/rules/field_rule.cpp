#include "wire/rules/field_rule.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace contact {
namespace {

using google::protobuf::FieldDescriptor;

bool IsDuration(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE &&
         field.message_type()->full_name() == "google.protobuf.Duration";
}

bool IsNumber(const FieldDescriptor& field) {
  return !field.is_repeated() && (field.cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ||
                                  field.cpp_type() == FieldDescriptor::CPPTYPE_INT32 ||
                                  field.cpp_type() == FieldDescriptor::CPPTYPE_INT64);
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
  const v1::FieldRule& rule = RuleOf(field);
  Range range;
  if (rule.low_case() == v1::FieldRule::LOW_NOT_SET) return range;
  range.open = rule.has_above();
  range.low = range.open ? rule.above() : rule.min();
  range.text = RangeText(field);
  if (rule.has_max()) {
    range.high = rule.max();
    range.text.insert(0, "in ");
  }
  return range;
}

std::optional<double> NumberField::Find(const google::protobuf::Message& message) const {
  if (has_presence && !reflection->HasField(message, descriptor)) return std::nullopt;
  switch (type) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection->GetInt32(message, descriptor);
    case FieldDescriptor::CPPTYPE_INT64:
      return static_cast<double>(reflection->GetInt64(message, descriptor));
    default:
      return reflection->GetDouble(message, descriptor);
  }
}

NumberFields::NumberFields(const google::protobuf::Message& prototype) {
  const google::protobuf::Descriptor& type = *prototype.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    if (!IsNumber(field)) continue;
    const auto number = static_cast<std::size_t>(field.number());
    if (fields_.size() <= number) fields_.resize(number + 1);
    const v1::FieldRule& rule = RuleOf(field);
    fields_[number] = {.descriptor = &field,
                       .reflection = prototype.GetReflection(),
                       .type = field.cpp_type(),
                       .has_presence = field.has_presence(),
                       .range = RangeOf(field),
                       .default_value = rule.default_number(),
                       .required = rule.required()};
  }
}

const NumberField& NumberFields::operator[](int number) const {
  const NumberField& field = fields_[static_cast<std::size_t>(number)];
  assert(field.descriptor != nullptr);
  return field;
}

}  // namespace contact
