#pragma once

#include <optional>
#include <string>

namespace contact::cli {

/// One end of a range.
struct Bound {
  double value = 0;
  bool open = false;  ///< The value itself is outside.
};

/// The rules of a field that its comment in the contract states in fixed words, such as
/// `Required. Range: (0, 1]. Default: 1.` What it says in other words is not here.
struct FieldRules {
  bool required = false;  ///< Always, not only beside some other field.
  std::optional<Bound> low;
  std::optional<Bound> high;
  std::string default_value;  ///< Its first word; empty without one.
  std::optional<int> max_characters;
  std::optional<int> max_entries;
};

FieldRules RulesOf(const std::string& comment);

}  // namespace contact::cli
