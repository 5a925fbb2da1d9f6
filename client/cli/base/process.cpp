#include "cli/base/process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "base/file_descriptor.h"

namespace contact::cli {
namespace {

struct Pipe {
  FileDescriptor read_end;
  FileDescriptor write_end;
};

Pipe MakePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

// Fills the buffer as far as data come before the end of the pipe.
std::size_t Read(int fd, char* data, std::size_t size) {
  std::size_t filled = 0;
  while (filled < size) {
    const ssize_t n = read(fd, data + filled, size - filled);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    filled += static_cast<std::size_t>(n);
  }
  return filled;
}

// In the new process, where only async-signal-safe functions may be called. `failed` receives the
// errno if the program cannot be run.
[[noreturn]] void Become(char* const* arguments, const ProcessOptions& options, pid_t parent,
                         int failed) {
  if (options.ends_with_us) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
  }
  if (options.own_group) setpgid(0, 0);
  if (options.input >= 0) dup2(options.input, STDIN_FILENO);
  if (options.output >= 0) dup2(options.output, STDOUT_FILENO);
  if (options.errors >= 0) dup2(options.errors, STDERR_FILENO);
  if (options.silent_errors) dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execvp(arguments[0], arguments);
  const int error = errno;
  [[maybe_unused]] const ssize_t told = write(failed, &error, sizeof error);
  _exit(127);
}

// Ends with a null, as exec wants it.
std::vector<char*> PointersTo(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

}  // namespace

void BecomeProcess(const std::vector<std::string>& command) {
  execvp(command.front().c_str(), PointersTo(command).data());
  throw std::system_error(errno, std::generic_category(), command.front());
}

pid_t StartProcess(const std::vector<std::string>& command, const ProcessOptions& options) {
  const std::vector<char*> arguments = PointersTo(command);
  Pipe failure = MakePipe();  // Closed by a successful exec, without data.
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process == 0) Become(arguments.data(), options, parent, failure.write_end.get());
  int error = process < 0 ? errno : 0;
  failure.write_end = FileDescriptor();
  if (process > 0) Read(failure.read_end.get(), reinterpret_cast<char*>(&error), sizeof error);
  if (error == 0) return process;
  if (process > 0) WaitForProcess(process);
  throw std::system_error(error, std::generic_category(), command.front());
}

int WaitForProcess(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return ExitCodeOf(status);
}

int ExitCodeOf(int status) {
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::optional<std::string> OutputOf(const std::vector<std::string>& command,
                                    ProcessOptions options) {
  try {
    Pipe output = MakePipe();
    options.output = output.write_end.get();
    const pid_t process = StartProcess(command, options);
    output.write_end = FileDescriptor();
    std::string text;
    std::array<char, 4096> block{};
    while (const std::size_t size = Read(output.read_end.get(), block.data(), block.size())) {
      text.append(block.data(), size);
    }
    if (WaitForProcess(process) == 0) return text;
  } catch (const std::system_error&) {
  }
  return std::nullopt;
}

}  // namespace contact::cli
