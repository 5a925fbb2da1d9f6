#pragma once

#include <google/protobuf/generated_enum_reflection.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "wire/violation.h"

namespace contact {

/// The interval that a value must lie in, with the words of the contract: `(0, 1e12]`. Its ends
/// belong to it unless the text begins with a parenthesis.
struct Range {
  double low;
  double high;
  std::string_view text;

  /// False for NaN and infinity.
  bool Contains(double value) const;
};

/// Checks the fields of one message of a scenario and notes which rules they break. Paths are
/// only built for broken rules.
class Rules {
 public:
  static constexpr std::size_t kMostViolations = 100;

  /// For the message at `message[index]`, or at `message` if the index is negative, or for the
  /// scenario itself. `violations` outlives this.
  explicit Rules(std::vector<Violation>* violations, std::string_view message = {}, int index = -1)
      : violations_(violations), message_(message), index_(index) {}

  /// Notes that `field` breaks a rule.
  void Break(std::string_view field, std::string description, std::string hint = {}) const;

  /// `field` must lie in the range.
  void Require(std::string_view field, double value, const Range& range) const;

  /// `field` must have one of the values that this version can do; not to choose is always right.
  template <class Enum>
  void RequireAvailable(std::string_view field, Enum value,
                        std::initializer_list<Enum> available) const {
    if (value == 0 || std::ranges::find(available, value) != available.end()) return;
    const auto* descriptor = google::protobuf::GetEnumDescriptor<Enum>();
    BreakChoice(field, *descriptor, value);
  }

  /// True while no rule of the scenario is broken.
  bool empty() const { return violations_->empty(); }

  /// True when nothing more is noted, so that work on hints can be spared.
  bool full() const { return violations_->size() >= kMostViolations; }

 private:
  void BreakChoice(std::string_view field, const google::protobuf::EnumDescriptor& descriptor,
                   int value) const;
  std::string Path(std::string_view field) const;

  std::vector<Violation>* violations_;
  std::string_view message_;
  int index_;
};

}  // namespace contact
