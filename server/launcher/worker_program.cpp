#include "launcher/worker_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace contact::launcher {
namespace {

using namespace std::chrono_literals;

// The command by a name that means the same on another machine.
std::string PathOf(const std::string& command) {
  std::error_code error;
  const auto path = std::filesystem::read_symlink(command, error);
  return error || command != "/proc/self/exe" ? command : path.string();
}

}  // namespace

Program WorkerProgram(const LauncherOptions& options, const std::string& store,
                      const std::vector<std::string>& environment) {
  Program program;
  program.words = {PathOf(options.worker.command), "--role=worker",
                   fmt::format("--workers={}", options.limits.threads),
                   fmt::format("--exit-when-idle={}s", options.worker.exit_when_idle.count())};
  if (options.engine == Engine::kSlurm && options.slurm.time > 0min) {
    program.words.push_back(fmt::format("--stop-after={}s", StopAfter(options.slurm.time).count()));
  }
  program.words.insert(program.words.end(), options.worker.options.begin(),
                       options.worker.options.end());
  for (const std::string& variable : environment) {
    if (!variable.starts_with("CONTACTD_")) program.environment.push_back(variable);
  }
  program.environment.push_back("CONTACTD_STORE=" + store);
  return program;
}

std::vector<std::string> OwnEnvironment() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable)
    variables.emplace_back(*variable);
  return variables;
}

std::chrono::seconds StopAfter(std::chrono::seconds limit) {
  return limit - std::min<std::chrono::seconds>(2min, limit / 2);
}

}  // namespace contact::launcher
