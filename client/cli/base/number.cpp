#include "cli/base/number.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "base/duration.h"
#include "cli/base/failure.h"

namespace contact::cli {

std::string Digits(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

std::string RelativeError(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.1e}", value);
}

std::string Seconds(double seconds) {
  if (seconds == 0) return "0 s";
  if (std::abs(seconds) < 1e-3) return fmt::format("{:.3g} µs", seconds * 1e6);
  if (std::abs(seconds) < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  return fmt::format("{:.4g} s", seconds);
}

std::string Instant(const google::protobuf::Timestamp& time) {
  if (time.seconds() == 0) return "-";
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(static_cast<std::time_t>(time.seconds())));
}

std::chrono::milliseconds RequireDuration(const std::string& text) {
  const std::optional<std::chrono::milliseconds> duration = ParseDuration(text);
  if (!duration) throw Failure(ExitCode::kUsage, NotADuration(text));
  if (duration->count() == 0) throw Failure(ExitCode::kUsage, "a duration of 0 is too short");
  return *duration;
}

}  // namespace contact::cli
