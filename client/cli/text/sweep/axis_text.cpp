#include "cli/text/sweep/axis_text.h"

#include <fmt/format.h>

#include <string_view>

#include "cli/base/number.h"
#include "wire/sweep/axis_words.h"

namespace contact::cli {

std::string AxisText(const v1::Sweep::Axis& axis, double value, int digits) {
  const std::string_view word = AxisWord(axis, value);
  if (!word.empty()) return std::string(word);
  return digits == 0 ? fmt::to_string(value) : Digits(value, digits);
}

}  // namespace contact::cli
