#pragma once

#include <stdexcept>
#include <string>

namespace contact::cli {

/// Exit codes of contactctl.
enum class ExitCode {
  kOk = 0,
  /// The job is FAILED or CANCELLED, or the server refused for a reason without a code of its own.
  kRunFailed = 1,
  kUsage = 2,            ///< Wrong command line.
  kInvalidScenario = 3,  ///< A scenario or sweep breaks a rule, or a file is malformed.
  kUnreachable = 4,      ///< No connection to the server.
  kTimeout = 5,          ///< The time limit of the command has passed.
  kNotFound = 6,         ///< There is no such job, event or artifact.
  kNotConverged = 7,     ///< The job succeeded, but not every cycle has its restitution.
  kDiffers = 8,          ///< A number is further from its reference than documented.
  kAuth = 9,             ///< The server demands credentials.
  kOverload = 10,        ///< A limit of the server was reached; try again later.
  kLocal = 11,           ///< A local file or program failed.
  kInterrupted = 130,    ///< Ctrl-C.
};

/// Ends the command with a message for people and a code for the shell.
class Failure : public std::runtime_error {
 public:
  /// `message` is printed after `contactctl: `; it may have several lines and has no full stop.
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// What contactctl exits with.
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace contact::cli
