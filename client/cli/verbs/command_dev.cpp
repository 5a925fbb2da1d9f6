#include <fmt/format.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <system_error>

#include "cli/base/message.h"
#include "cli/base/process.h"
#include "cli/link/local_server.h"
#include "cli/settings/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct DevArguments {
  std::string contactd;
  std::vector<std::string> command;
};

// Blocks the signals that end the command, for sigwait. Called before the server starts, so that
// no signal is lost.
sigset_t BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

int Next(const sigset_t& signals) {
  int signal = 0;
  while (sigwait(&signals, &signal) != 0) {
  }
  return signal;
}

bool HasEnded(pid_t process, int* status) { return waitpid(process, status, WNOHANG) == process; }

// Runs the command and returns its exit code. SIGTERM and SIGHUP are passed on to the command; the
// terminal sends it Ctrl-C by itself.
ExitCode RunCommand(const DevArguments& arguments, const LocalServer& server,
                    const sigset_t& signals) {
  setenv("CONTACT_SERVER", server.address().c_str(), 1);
  try {
    const pid_t process = StartProcess(arguments.command, {.ends_with_us = true});
    int status = 0;
    while (!HasEnded(process, &status)) {
      const int signal = Next(signals);
      if (signal == SIGTERM || signal == SIGHUP) kill(process, signal);
    }
    return static_cast<ExitCode>(ExitCodeOf(status));
  } catch (const std::system_error& error) {
    constexpr int kNoSuchCommand = 127;  // The code of a shell.
    Tell("contactctl: cannot run {}\n", error.what());
    return static_cast<ExitCode>(kNoSuchCommand);
  }
}

ExitCode WaitForEnd(const LocalServer& server, const sigset_t& signals) {
  for (;;) {
    const int signal = Next(signals);
    if (signal != SIGCHLD) return ExitCode::kOk;
    siginfo_t ended = {};
    waitid(P_PID, static_cast<id_t>(server.process()), &ended, WEXITED | WNOHANG | WNOWAIT);
    if (ended.si_pid == 0) continue;
    throw Failure(ExitCode::kLocal, "contactd ended; what it said stands above");
  }
}

ExitCode Dev(const DevArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kName});
  const sigset_t signals = BlockSignals();
  const auto start = Clock::now();
  const LocalServer server(arguments.contactd.empty() ? FindContactd() : arguments.contactd);
  if (!arguments.command.empty()) return RunCommand(arguments, server, signals);
  if (settings.output == OutputFormat::kName) {
    fmt::print("{}\n", server.address());
  } else {
    const std::chrono::duration<double> passed = Clock::now() - start;
    fmt::print(
        "contactd at {0}, ready in {1:.2f} s; its jobs are gone when it ends\n"
        "  use it   export CONTACT_SERVER={0}\n"
        "  see it   {2}\n"
        "  stop it  Ctrl-C\n",
        server.address(), passed.count(), server.http_address());
  }
  std::fflush(stdout);
  return WaitForEnd(server, signals);
}

}  // namespace

void AddDev(CommandLine& line, CLI::App& command) {
  auto arguments = std::make_shared<DevArguments>();
  AddOption(line, command, "--contactd", &arguments->contactd, ValueKind::kFile,
            "The server's program. Default: beside contactctl, else in the PATH");
  command.add_option(
      "CMD", arguments->command,
      "Command, after --; CONTACT_SERVER names the server to it, and its exit code is returned");
  line.SetAction(command, arguments, Dev);
}

}  // namespace contact::cli
