#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact::cli {

/// Reads values as YAML and JSON write them: the whole text, in no one's locale.

/// A number, `.inf` and `.nan` included. Nothing if the text is no number, or one that a double
/// cannot hold.
std::optional<double> ParseNumber(std::string_view text);

/// `true` or `false`, in lower, upper or title case. Nothing for any other text.
std::optional<bool> ParseBool(std::string_view text);

/// A whole number, also written as `1e8`. Nothing if the text is none or `Integer` cannot hold it.
template <class Integer>
std::optional<Integer> ParseInteger(std::string_view text) {
  Integer value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return value;
  const std::optional<double> number = ParseNumber(text);
  const auto limit = std::ldexp(1.0, std::numeric_limits<Integer>::digits);
  if (!number || std::abs(*number) >= limit || std::trunc(*number) != *number) return std::nullopt;
  return static_cast<Integer>(*number);
}

/// True if the bytes are well-formed UTF-8, which protobuf demands of texts.
bool IsUtf8(std::string_view text);

/// Reads NAME=VALUE texts into values by name. The first `=` ends the name; the last value of a
/// name counts. Throws Failure (kUsage), which names `flag` and the `expected` form, for a text
/// without a name or without `=`.
std::map<std::string, std::string> ParseAssignments(const std::vector<std::string>& texts,
                                                    std::string_view flag,
                                                    std::string_view expected);

}  // namespace contact::cli
