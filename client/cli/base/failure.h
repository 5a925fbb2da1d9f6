#pragma once

#include <stdexcept>
#include <string>

namespace contact::cli {

/// What contactctl tells the shell.
enum class ExitCode {
  kOk = 0,
  kRunFailed =
      1,       ///< The job is FAILED or CANCELLED, or the server refused for a reason below none.
  kUsage = 2,  ///< Wrong command line.
  kInvalidScenario = 3,
  kUnreachable = 4,
  kTimeout = 5,
  kNotFound = 6,
  kNotConverged = 7,  ///< The job succeeded, but not every cycle has its restitution.
  kDiffers = 8,       ///< A number is further from its reference than documented.
  kAuth = 9,
  kOverload = 10,  ///< Try again later.
  kLocal = 11,     ///< A local file or tool.
  kInterrupted = 130,
};

/// Ends the command with a message for people and a code for the shell.
class Failure : public std::runtime_error {
 public:
  Failure(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace contact::cli
