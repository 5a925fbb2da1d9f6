#include "base/duration.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/spelling.h"

namespace contact {
namespace {

struct Unit {
  std::string_view name;
  double milliseconds;
};

constexpr std::array<Unit, 6> kUnits{
    {{"", 1e3}, {"ms", 1}, {"s", 1e3}, {"m", 6e4}, {"h", 3.6e6}, {"d", 8.64e7}}};

}  // namespace

std::optional<std::chrono::milliseconds> ParseDuration(std::string_view text) {
  constexpr std::chrono::milliseconds kLongest = kLongestDuration;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || std::signbit(number)) return std::nullopt;
  std::string_view name(rest, static_cast<std::size_t>(end - rest));
  while (name.starts_with(' ')) name.remove_prefix(1);
  for (const Unit& unit : kUnits) {
    if (unit.name != name) continue;
    const double milliseconds = std::ceil(number * unit.milliseconds);
    // Also false for NaN.
    if (!(milliseconds <= static_cast<double>(kLongest.count()))) return std::nullopt;
    return std::chrono::milliseconds(std::llround(milliseconds));
  }
  return std::nullopt;
}

std::string NotADuration(std::string_view text) {
  return fmt::format(
      "{} is not a duration; give seconds, or a number with ms, s, m, h or d, such as 250ms, 10s, "
      "5m, 12h or 30d",
      Quoted(text));
}

}  // namespace contact
