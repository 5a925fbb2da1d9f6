#include "cli/link/local_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <system_error>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience{30};

[[noreturn]] void Fail(const std::string& what) {
  throw Failure(ExitCode::kLocal,
                fmt::format("{}: {}", what, std::generic_category().message(errno)));
}

std::filesystem::path MakeFolder() {
  std::string folder = (std::filesystem::temp_directory_path() / "contactd-dev-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) Fail(folder);
  return folder;
}

// Between fork and exec only what is safe there. The server has a process group of its own, so
// that a Ctrl-C reaches it through us, after whoever still uses it.
[[noreturn]] void Become(std::array<char*, 5> arguments, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  setpgid(0, 0);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(output, STDOUT_FILENO);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

LocalServer::LocalServer(const std::string& program) : folder_(MakeFolder()) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) Fail("pipe");
  std::string name = program;
  std::string listen = "--listen=127.0.0.1:0";
  std::string data = "--data-dir=" + (folder_ / "data").string();
  std::string log = "--log-level=warn";
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {
    Become({name.data(), listen.data(), data.data(), log.data(), nullptr}, pipe_ends[1], parent);
  }
  close(pipe_ends[1]);
  const std::string greeting = process_ < 0 ? "" : WaitForGreeting(pipe_ends[0]);
  close(pipe_ends[0]);
  constexpr std::string_view kBefore = " listening on ";
  const std::size_t begin = greeting.find(kBefore);
  const std::size_t end = greeting.find(',', begin);
  if (begin == std::string::npos || end == std::string::npos) {
    End();
    throw Failure(ExitCode::kLocal, fmt::format("{} did not start; --contactd FILE names another, "
                                                "and what it said stands above",
                                                program));
  }
  address_ = greeting.substr(begin + kBefore.size(), end - begin - kBefore.size());
}

LocalServer::~LocalServer() { End(); }

void LocalServer::End() {
  if (process_ > 0) {
    kill(process_, SIGTERM);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

// Its first line, or what came of it before its end.
std::string LocalServer::WaitForGreeting(int output) {
  std::string text;
  const auto deadline = Clock::now() + kPatience;
  while (text.find('\n') == std::string::npos && Clock::now() < deadline) {
    pollfd wait = {.fd = output, .events = POLLIN, .revents = 0};
    if (poll(&wait, 1, 100) <= 0) continue;
    std::array<char, 512> block{};
    const ssize_t size = read(output, block.data(), block.size());
    if (size <= 0) break;
    text.append(block.data(), static_cast<std::size_t>(size));
  }
  return text;
}

std::string FindContactd() {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const auto& place : {self / "contactd", self / "../../server/contactd"}) {
    if (!error && access(place.c_str(), X_OK) == 0) return place.lexically_normal().string();
  }
  return "contactd";
}

}  // namespace contact::cli
