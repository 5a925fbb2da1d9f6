#include "launcher/process.h"

#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "base/file_descriptor.h"

namespace contact::launcher {
namespace {

// The attributes and file actions of posix_spawn.
class SpawnSettings {
 public:
  explicit SpawnSettings(const std::array<int, 3>& descriptors) {
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setflags(
        &attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    for (int i = 0; i < 3; ++i) {
      posix_spawn_file_actions_adddup2(&actions, descriptors[static_cast<std::size_t>(i)], i);
    }
  }
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t actions;
};

// The texts as exec takes them. They must outlive the result.
std::vector<char*> Pointers(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

// A file in memory that holds the text, read from its start. Unlike a pipe it makes nobody wait.
FileDescriptor MemoryFile(std::string_view text) {
  FileDescriptor file(memfd_create("contactd", MFD_CLOEXEC));
  while (!text.empty()) {
    const ssize_t written = ::write(file.get(), text.data(), text.size());
    if (written <= 0) return FileDescriptor();
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  ::lseek(file.get(), 0, SEEK_SET);
  return file;
}

std::string ContentOf(const FileDescriptor& file) {
  std::string text;
  std::array<char, 4096> block{};
  for (;;) {
    const ssize_t size =
        ::pread(file.get(), block.data(), block.size(), static_cast<off_t>(text.size()));
    if (size <= 0) return text;
    text.append(block.data(), static_cast<std::size_t>(size));
  }
}

// The first line that says anything.
std::string_view FirstLine(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\n'), text.size()));
  return text.substr(0, text.find('\n'));
}

}  // namespace

absl::StatusOr<pid_t> Spawn(const Program& program, const std::array<int, 3>& descriptors) {
  const SpawnSettings settings(descriptors);
  pid_t child = 0;
  const int error =
      posix_spawnp(&child, program.words.front().c_str(), &settings.actions, &settings.attributes,
                   Pointers(program.words).data(), Pointers(program.environment).data());
  if (error == 0) return child;
  return absl::UnavailableError(
      fmt::format("cannot run {}: {}", program.words.front(), std::strerror(error)));
}

std::optional<int> WaitFor(pid_t child, std::chrono::milliseconds longest) {
  const FileDescriptor process(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  pollfd wait{.fd = process.get(), .events = POLLIN, .revents = 0};
  while (::poll(&wait, 1, static_cast<int>(longest.count())) < 0 && errno == EINTR) {
  }
  int status = 0;
  if (::waitpid(child, &status, WNOHANG) != child) return std::nullopt;
  return status;
}

void Kill(pid_t child) {
  ::kill(child, SIGKILL);
  while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::string HowItEnded(int status) {
  if (WIFSIGNALED(status)) return fmt::format("was ended by signal {}", WTERMSIG(status));
  return fmt::format("ended with code {}", WEXITSTATUS(status));
}

absl::StatusOr<std::string> OutputOf(const Program& program, const std::string& input,
                                     std::chrono::milliseconds longest) {
  const FileDescriptor in = MemoryFile(input), out = MemoryFile(""), errors = MemoryFile("");
  const auto child = Spawn(program, {in.get(), out.get(), errors.get()});
  if (!child.ok()) return child.status();
  const std::string& name = program.words.front();
  const std::optional<int> status = WaitFor(*child, longest);
  if (!status) {
    Kill(*child);
    return absl::UnavailableError(fmt::format("{} does not end", name));
  }
  if (*status == 0) return ContentOf(out);
  return absl::UnavailableError(
      fmt::format("{} {}: {}", name, HowItEnded(*status), FirstLine(ContentOf(errors))));
}

}  // namespace contact::launcher
