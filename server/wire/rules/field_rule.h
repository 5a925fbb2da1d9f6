#pragma once

#include <google/protobuf/message.h>

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
  bool open = false;            ///< `low` itself is not allowed.
  std::string text = "finite";  ///< The interval in words: `in (0, 1e12]`, `> 0`.

  /// False for NaN and the infinities.
  bool Contains(double value) const;
};

/// The range that the contract states for a field; every finite number if it states none.
Range RangeOf(const google::protobuf::FieldDescriptor& field);

/// A field that holds a number, with all that is needed to read and check it. What descriptor and
/// message know themselves is kept here for speed.
struct NumberField {
  const google::protobuf::FieldDescriptor* descriptor = nullptr;
  const google::protobuf::Reflection* reflection = nullptr;  ///< That of the message type.
  google::protobuf::FieldDescriptor::CppType type = {};
  bool has_presence = false;  ///< A message distinguishes unset from 0.
  Range range;
  double default_value = 0;  ///< 0 if the contract states none.
  bool required = false;

  /// The value of the field; none if `message` can tell that the field is unset and it is.
  std::optional<double> Find(const google::protobuf::Message& message) const;
};

/// The numbers among the fields of a type of message, by field number.
class NumberFields {
 public:
  /// Reads the rules of all fields, which takes some microseconds: done once for each type.
  /// `prototype` is any message of the type.
  explicit NumberFields(const google::protobuf::Message& prototype);

  /// The field with this number, which exists and holds a double or an integer.
  const NumberField& operator[](int number) const;

 private:
  std::vector<NumberField> fields_;  // Without a descriptor where no number has the field number.
};

/// The number in `Message` with this field number. Safe to call from any thread.
template <class Message>
const NumberField& NumberOf(int number) {
  static const NumberFields fields(Message::default_instance());
  return fields[number];
}

}  // namespace contact
