#include "cli/link/local_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

#include "base/file_descriptor.h"
#include "cli/base/failure.h"
#include "cli/base/process.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// The file with the port of the gateway. It is there before that with the other port.
constexpr char kHttpPort[] = "http-port";

bool HasEnded(pid_t process) {
  siginfo_t ended = {};
  waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT);
  return ended.si_pid != 0;
}

[[noreturn]] void FailToStart(const std::string& program, const std::string& why) {
  throw Failure(ExitCode::kLocal,
                fmt::format("{} did not start; --contactd FILE names another{}", program, why));
}

// The server has a process group of its own, so that a Ctrl-C reaches it through us, after whoever
// still uses it.
pid_t Start(const std::string& program, const fs::path& folder, const std::string& port_file) {
  const FileDescriptor null(open("/dev/null", O_WRONLY | O_CLOEXEC));
  try {
    return StartProcess(
        {program, "--listen=127.0.0.1:0", "--data-dir", folder / "data", "--port-file", port_file,
         "--http-listen=127.0.0.1:0", "--http-port-file", folder / kHttpPort, "--log-level=warn"},
        {.ends_with_us = true, .own_group = true, .output = null.get()});
  } catch (const std::system_error& error) {
    FailToStart(program, ": " + error.code().message());
  }
}

void End(pid_t process) {
  kill(process, SIGTERM);
  WaitForProcess(process);
}

}  // namespace

LocalServer::LocalServer(const std::string& program) {
  const std::string port_file = folder_.path() / "port";
  process_ = Start(program, folder_.path(), port_file);
  const std::string port = WaitForPort(port_file);
  if (port.empty()) {
    End(process_);
    FailToStart(program, ", and what it said stands above");
  }
  address_ = "127.0.0.1:" + port;
}

std::string LocalServer::http_address() const {
  std::string port;
  std::ifstream(folder_.path() / kHttpPort) >> port;
  return "http://127.0.0.1:" + port;
}

LocalServer::~LocalServer() { End(process_); }

std::string LocalServer::WaitForPort(const std::string& port_file) const {
  constexpr std::chrono::seconds kPatience{30};
  constexpr std::chrono::milliseconds kPause{5};
  const auto deadline = Clock::now() + kPatience;
  std::string port;
  while (!(std::ifstream(port_file) >> port) && !HasEnded(process_) && Clock::now() < deadline) {
    std::this_thread::sleep_for(kPause);
  }
  return port;
}

std::string FindContactd() {
  std::error_code error;
  const auto self = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const auto& place : {self / "contactd", self / "../../server/contactd"}) {
    if (!error && access(place.c_str(), X_OK) == 0) return place.lexically_normal().string();
  }
  return "contactd";
}

}  // namespace contact::cli
