#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace contact::cli {

/// How StartProcess sets up a program. Its other file descriptors and variables are ours.
struct ProcessOptions {
  /// It receives SIGTERM when the thread that started it ends.
  bool ends_with_us = false;
  /// It has a process group of its own, so that the terminal's Ctrl-C does not reach it.
  bool own_group = false;
  /// Its standard error is /dev/null.
  bool silent_errors = false;
  /// The descriptor that becomes its standard input; -1: it has ours.
  int input = -1;
  /// The same for its standard output.
  int output = -1;
  /// The same for its standard error.
  int errors = -1;
};

/// Starts a program without a shell; no signal is blocked in it. `command` is the program, a path
/// or a name to look for in the PATH, and its arguments. The caller waits for its end. Throws
/// std::system_error with the reason, such as ENOENT, if it cannot be run.
pid_t StartProcess(const std::vector<std::string>& command, const ProcessOptions& options = {});

/// Becomes a program, in place of this one. Throws as StartProcess.
[[noreturn]] void BecomeProcess(const std::vector<std::string>& command);

/// Waits for the end of a process. Returns its exit code, or 128 + the signal that ended it.
int WaitForProcess(pid_t process);

/// The exit code for a status of waitpid: that of the process, or 128 + the signal that ended it.
int ExitCodeOf(int status);

/// What a program writes to its standard output. Nothing if it cannot be run or its exit code is
/// not 0.
std::optional<std::string> OutputOf(const std::vector<std::string>& command,
                                    ProcessOptions options = {});

}  // namespace contact::cli
