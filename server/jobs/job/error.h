#pragma once

#include <absl/status/status.h>

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "wire/rules/violation.h"

namespace contact {

/// Why a call failed, as the contract tells it: canonical code, reason for programs, words for
/// people. rpc/ turns it into a gRPC status with details.
struct Error {
  absl::StatusCode code = absl::StatusCode::kInternal;
  std::string reason = {};  ///< UPPER_SNAKE_CASE, listed in job_service.proto.
  std::string message = {};
  std::vector<Violation> violations = {};            ///< Become BadRequest.
  std::map<std::string, std::string> metadata = {};  ///< Of ErrorInfo.
  std::chrono::milliseconds retry_after{0};          ///< > 0 becomes RetryInfo.
};

/// A value or the reason why there is none.
template <class T>
class Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)
  bool ok() const { return std::holds_alternative<T>(state_); }
  T& value() { return std::get<T>(state_); }
  const T& value() const { return std::get<T>(state_); }
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

}  // namespace contact
