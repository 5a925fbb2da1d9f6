#pragma once

#include <absl/status/statusor.h>
#include <sys/types.h>

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace contact::launcher {

/// A program to run, without a shell.
struct Program {
  std::vector<std::string> words;        ///< The first is a path, or a name in PATH.
  std::vector<std::string> environment;  ///< `NAME=value` each.
};

/// Starts the program in a process group of its own, with no signal blocked. `descriptors`: its
/// input, output and errors. The caller waits for its end.
absl::StatusOr<pid_t> Spawn(const Program& program, const std::array<int, 3>& descriptors);

/// Waits for the end of a child. Returns what waitpid tells; nothing if it takes longer.
std::optional<int> WaitFor(pid_t child, std::chrono::milliseconds longest);

/// Ends a child at once, and waits for that.
void Kill(pid_t child);

/// How a process ended, for people: `ended with code 3`. `status`: of waitpid.
std::string HowItEnded(int status);

/// Runs the program to its end and answers what it wrote. UNAVAILABLE: it cannot be run, takes
/// longer than `longest`, which ends it, or fails; the message has the first line of its errors.
absl::StatusOr<std::string> OutputOf(const Program& program, const std::string& input = "",
                                     std::chrono::milliseconds longest = std::chrono::seconds(20));

}  // namespace contact::launcher
