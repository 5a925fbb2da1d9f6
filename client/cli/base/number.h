#pragma once

#include <google/protobuf/timestamp.pb.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace contact::cli {

/// A number with `digits` significant digits; `-` for NaN.
std::string Digits(double value, int digits);

/// A relative error: `1.2e-10`; `-` for NaN.
std::string RelativeError(double value);

/// A time, given in seconds, in µs, ms or s, so that it needs few digits: `63 µs`, `2.5 ms`, `4 s`.
std::string Seconds(double seconds);

/// `2026-11-21 01:07:00` in UTC; `-` if unset.
std::string Instant(const google::protobuf::Timestamp& time);

/// Reads a duration as ParseDuration of base/duration.h does: `10`, in seconds, `500ms`, `2m` or
/// `30d`. Throws Failure (kUsage) if the text is none, or for 0.
std::chrono::milliseconds RequireDuration(const std::string& text);

}  // namespace contact::cli
