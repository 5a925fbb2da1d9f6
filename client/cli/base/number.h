#pragma once

#include <google/protobuf/timestamp.pb.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace contact::cli {

/// A number with so many significant digits; `-` for NaN.
std::string Digits(double value, int digits);

/// A relative error: `1.2e-10`; `-` for NaN.
std::string Error(double value);

/// A time in the unit that suits it: `63 µs`, `2.5 ms`, `4 s`.
std::string Seconds(double seconds);

/// `1 body`, `2 bodies`.
std::string Count(std::int64_t count, std::string_view one, std::string_view many);

/// `2026-11-21 01:07:00` in UTC; `-` if unset.
std::string Instant(const google::protobuf::Timestamp& time);

/// Reads `10`, `10s`, `500ms`, `2m` or `1h`; seconds without a unit. Throws Failure (kUsage).
std::chrono::milliseconds ParseDuration(const std::string& text);

}  // namespace contact::cli
