#include "cli/base/number.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "cli/base/failure.h"
#include "cli/base/scalar.h"

namespace contact::cli {

std::string Digits(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

std::string Error(double value) { return std::isnan(value) ? "-" : fmt::format("{:.1e}", value); }

std::string Seconds(double seconds) {
  if (seconds == 0) return "0 s";
  if (std::abs(seconds) < 1e-3) return fmt::format("{:.3g} µs", seconds * 1e6);
  if (std::abs(seconds) < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.4g} s", seconds);
}

std::string Count(std::int64_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string Instant(const google::protobuf::Timestamp& time) {
  if (time.seconds() == 0) return "-";
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(time.seconds())));
}

std::chrono::milliseconds ParseDuration(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 5> kUnits{
      {{"ms", 1}, {"s", 1e3}, {"m", 6e4}, {"h", 3.6e6}, {"", 1e3}}};
  constexpr double kLongest = 1e12;  // 30 years
  for (const auto& [unit, milliseconds] : kUnits) {
    if (!text.ends_with(unit)) continue;
    const auto number = ParseNumber(std::string_view(text).substr(0, text.size() - unit.size()));
    if (!number || !(*number > 0) || *number * milliseconds > kLongest) break;
    return std::chrono::milliseconds(std::llround(std::ceil(*number * milliseconds)));
  }
  throw Failure(
      ExitCode::kUsage,
      fmt::format("'{}' is no time; give seconds, or such as 500ms, 10s, 2m or 1h", text));
}

}  // namespace contact::cli
