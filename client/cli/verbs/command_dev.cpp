#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>  // Some file of the library must have all of it, or it lacks vtables.
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>

#include "cli/link/local_server.h"
#include "cli/verbs/commands.h"

namespace contact::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct DevArguments {
  std::string contactd;
  std::vector<std::string> command;
};

// Blocked from before the server starts, so that none is lost; taken by sigwait.
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

pid_t Start(const std::vector<std::string>& command, const std::string& address) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  setenv("CONTACT_SERVER", address.c_str(), 1);
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process != 0) return process;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execvp(arguments.front(), arguments.data());
  constexpr int kNoSuchCommand = 127;  // As a shell says it.
  _exit(kNoSuchCommand);
}

// The code of `command`, which the terminal's Ctrl-C reaches by itself; other signals we pass on.
ExitCode RunCommand(const DevArguments& arguments, const LocalServer& server,
                    const sigset_t& signals) {
  constexpr int kSignalled = 128;
  const pid_t process = Start(arguments.command, server.address());
  int status = 0;
  while (!HasEnded(process, &status)) {
    const int signal = Next(signals);
    if (signal == SIGTERM || signal == SIGHUP) kill(process, signal);
  }
  if (WIFSIGNALED(status)) return static_cast<ExitCode>(kSignalled + WTERMSIG(status));
  if (WEXITSTATUS(status) == 127) {
    fmt::print(stderr, "contactctl: cannot run {}\n", arguments.command.front());
  }
  return static_cast<ExitCode>(WEXITSTATUS(status));
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
        "  stop it  Ctrl-C\n",
        server.address(), passed.count());
  }
  std::fflush(stdout);
  return WaitForEnd(server, signals);
}

}  // namespace

void AddDevCommand(CLI::App& app, const Settings& settings, Action* action) {
  auto arguments = std::make_shared<DevArguments>();
  CLI::App* dev = app.add_subcommand(
      "dev", "Start a private server to try things; dev -- CMD… runs one command with it");
  dev->add_option("--contactd", arguments->contactd,
                  "The server's program. Default: beside contactctl, else in the PATH")
      ->type_name("FILE");
  dev->add_option("CMD", arguments->command,
                  "Command, after --; finds the server in CONTACT_SERVER, and its code is ours");
  dev->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Dev(*arguments, settings); };
  });
}

}  // namespace contact::cli
