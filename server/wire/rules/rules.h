#pragma once

#include <google/protobuf/generated_enum_reflection.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wire/rules/field_rule.h"
#include "wire/rules/violation.h"

namespace contact {

/// Checks the fields of one message of a scenario and notes which rules they break. A path is only
/// built when a rule is broken.
class Rules {
 public:
  /// Violations noted for one scenario or sweep at most; what breaks a rule after that is not
  /// noted.
  static constexpr std::size_t kMostViolations = 100;

  /// For the message at `message[index]`, or at `message` if the index is negative, or for the
  /// whole if `message` is empty. `violations` and the text of `message` outlive this.
  explicit Rules(std::vector<Violation>* violations, std::string_view message = {}, int index = -1)
      : violations_(violations), message_(message), index_(index) {}

  /// For a message within this one. This and the text of `message` outlive the result.
  Rules In(std::string_view message, int index = -1) const {
    Rules rules(violations_, message, index);
    rules.parent_ = this;
    return rules;
  }

  /// Notes that `field` of the message breaks a rule; the message itself if `field` is empty.
  void Break(std::string_view field, std::string description, std::string hint = {}) const;

  /// `value` of `field` must lie in the range.
  void Require(std::string_view field, double value, const Range& range) const;

  /// The list `field` must not have more entries than `most`. Returns whether it has not.
  bool RequireAtMost(std::string_view field, std::int64_t entries, std::int64_t most) const;

  /// The text `field` must not have more characters than `most`.
  void RequireShort(std::string_view field, std::string_view text, int most) const;

  /// Returns `value`, which must lie in the range that the contract states for the number in
  /// `Message` with this field number. For messages of which a scenario has thousands: Read asks
  /// the message by reflection, which takes several times as long. The caller sees to fields that
  /// are unset.
  template <class Message>
  double Check(int number, double value) const {
    const NumberField& field = NumberOf<Message>(number);
    Require(field.descriptor->name(), value, field.range);
    return value;
  }

  /// The value of the number with this field number, or the default that the contract states while
  /// it is unset. Notes the rules of the contract that it breaks: it is required but missing, or
  /// out of its range. `hint`: what to do about a missing one.
  template <class Message>
  double Read(const Message& message, int number, std::string_view hint = {}) const {
    return Read(message, NumberOf<Message>(number), hint);
  }

  /// The text `field` must not have characters that steer a terminal, see Printable.
  void RequirePrintable(std::string_view field, std::string_view text) const;

  /// `field` must have one of the values of its enum. A newer client may send others.
  template <class Enum>
  void RequireKnown(std::string_view field, Enum value) const {
    RequireKnown(field, value, *google::protobuf::GetEnumDescriptor<Enum>());
  }

  /// True while no rule of the scenario is broken.
  bool empty() const { return violations_->empty(); }

  /// True when nothing more is noted, so that callers need not compose hints.
  bool full() const { return violations_->size() >= kMostViolations; }

 private:
  // Read for a number of `message`.
  double Read(const google::protobuf::Message& message, const NumberField& number,
              std::string_view hint) const;
  // RequireKnown for an enum of this type.
  void RequireKnown(std::string_view field, int value,
                    const google::protobuf::EnumDescriptor& type) const;
  // The path of a field from the scenario, such as `loads[3].sine.phase_rad`.
  std::string Path(std::string_view field) const;

  std::vector<Violation>* violations_;
  // Rules of the message around this one; null for the outermost.
  const Rules* parent_ = nullptr;
  std::string_view message_;
  int index_;
};

}  // namespace contact
