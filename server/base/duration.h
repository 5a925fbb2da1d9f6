#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace contact {

/// The longest duration that ParseDuration accepts: 100 years of 365 days.
inline constexpr std::chrono::hours kLongestDuration{24 * 36'500};

/// Reads a decimal number with one of the units ms, s, m, h, d, such as `250ms`, `10s`, `1.5m`,
/// `12h`, `30d`; a number without a unit is in seconds. Spaces may stand between number and unit.
///
/// The result is rounded up to whole milliseconds, so only zero becomes zero. Returns nothing if
/// the text has another form, is negative or not finite, or is longer than kLongestDuration.
std::optional<std::chrono::milliseconds> ParseDuration(std::string_view text);

/// The error message for a text that ParseDuration does not accept: quotes the text, says which
/// forms are accepted, and has no full stop.
std::string NotADuration(std::string_view text);

}  // namespace contact
