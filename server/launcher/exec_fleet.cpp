#include "launcher/exec_fleet.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <csignal>
#include <utility>

#include "base/file_descriptor.h"

namespace contact::launcher {

using namespace std::chrono_literals;

ExecFleet::ExecFleet(Program worker, std::chrono::milliseconds grace)
    : worker_(std::move(worker)), grace_(grace) {}

ExecFleet::~ExecFleet() {
  for (const pid_t child : children_) ::kill(child, SIGTERM);
  std::chrono::milliseconds left = grace_;
  for (const pid_t child : children_) {
    if (WaitFor(child, left)) continue;
    left = 0ms;  // The others have had the same time.
    Kill(child);
  }
}

absl::Status ExecFleet::Start(int count) {
  const FileDescriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  for (int i = 0; i < count; ++i) {
    const auto child = Spawn(worker_, {nothing.get(), STDERR_FILENO, STDERR_FILENO});
    if (!child.ok()) return child.status();
    children_.insert(*child);
  }
  return absl::OkStatus();
}

absl::StatusOr<int> ExecFleet::Count() {
  std::erase_if(children_, [](pid_t child) {
    const std::optional<int> status = WaitFor(child, 0ms);
    if (status && *status != 0) spdlog::warn("worker {} {}", child, HowItEnded(*status));
    return status.has_value();
  });
  return static_cast<int>(children_.size());
}

}  // namespace contact::launcher
