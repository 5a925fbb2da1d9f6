#pragma once

#include <google/protobuf/duration.pb.h>
#include <google/protobuf/message.h>

#include <cassert>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "contact/v1/field_rules.pb.h"

namespace contact {

/// The rules that the contract states for a field, the option `rule` of field_rules.proto; all
/// unset if the contract states none. `field` may belong to any descriptor pool. The reference
/// lives as long as that pool.
const v1::FieldRule& RuleOf(const google::protobuf::FieldDescriptor& field);

/// The rules of the field of `Message` with this number, which exists.
template <class Message>
const v1::FieldRule& RuleOf(int number) {
  return RuleOf(*Message::descriptor()->FindFieldByNumber(number));
}

/// A bound or default of a field as people write it: `1e12`, `0.5`; of a whole number of 32 bits
/// all digits; of a Duration with its unit, `1 h`, from `value` in seconds.
std::string NumberText(const google::protobuf::FieldDescriptor& field, double value);

/// The range of a field: `(0, 1e12]`, where a parenthesis excludes the bound; `> 0` or `≥ 0`
/// without an upper end; empty if there is no range.
std::string RangeText(const google::protobuf::FieldDescriptor& field);

/// The interval that a number must lie in.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  /// True if `low` itself is not allowed.
  bool open = false;
  /// The interval in words: `in (0, 1e12]`, `> 0`.
  std::string text = "finite";

  /// False for NaN and the infinities.
  bool Contains(double value) const;
};

/// The range that the contract states for a field; every finite number if it states none.
Range RangeOf(const google::protobuf::FieldDescriptor& field);

/// The length of a span in seconds.
double Seconds(const google::protobuf::Duration& span);

/// True if `span`, the value of `field`, is well-formed and in the range that the contract states.
bool IsInRange(const google::protobuf::FieldDescriptor& field,
               const google::protobuf::Duration& span);

/// True for a field that holds one number: a double, an integer, or an enum, which is its number.
bool IsNumber(const google::protobuf::FieldDescriptor& field);

/// The value of a field that IsNumber, or its default if it is unset.
double NumberIn(const google::protobuf::Message& message,
                const google::protobuf::FieldDescriptor& field);

/// A field that holds a number, and its rules.
struct NumberField {
  /// Null if no number has this field number.
  const google::protobuf::FieldDescriptor* descriptor = nullptr;
  Range range;
  /// What the unset field means; 0 if the contract states nothing.
  double default_value = 0;
  /// True if every message must set the field.
  bool required = false;

  /// The value of the field; none if `message` can tell that the field is unset and it is.
  std::optional<double> Find(const google::protobuf::Message& message) const;
};

/// The numbers among the fields of a type of message, by field number. Reads the rules of all
/// fields, which takes some microseconds.
std::vector<NumberField> NumbersOf(const google::protobuf::Descriptor& type);

/// The number in `Message` with this field number, which exists. The rules are read at the first
/// call for a type of message. Safe to call from any thread.
template <class Message>
const NumberField& NumberOf(int number) {
  static const std::vector<NumberField> fields = NumbersOf(*Message::descriptor());
  const NumberField& field = fields[static_cast<std::size_t>(number)];
  assert(field.descriptor != nullptr);
  return field;
}

}  // namespace contact
