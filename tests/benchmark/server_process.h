#pragma once

#include <sched.h>
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace contact {

/// A server in a process of its own, on a free port of this host, with a directory that goes with
/// it. It says where it listens as contactd does.
class ServerProcess {
 public:
  /// `command` gets `--listen` and `--data-dir` appended. Throws std::runtime_error if it does not
  /// come up.
  explicit ServerProcess(std::vector<std::string> command);
  ~ServerProcess();  ///< Asks it to end and waits; after 10 s it is killed.

  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  const std::string& address() const { return address_; }
  double ResidentMegabytes() const;
  /// What all its threads have used.
  double CpuSeconds() const;
  /// What those have used that solve; exact while none of them runs.
  double WorkerSeconds() const;
  pid_t pid() const { return pid_; }

 private:
  std::filesystem::path folder_;
  pid_t pid_ = -1;
  std::string address_;
};

/// Gives the workers of a server one core for themselves, and all other threads of it and of this
/// process another one, those to come too: so what is left of a slow-down is not the want of a
/// core. Everything has all cores again when it is destroyed.
class WorkersApart {
 public:
  explicit WorkersApart(const ServerProcess& server);
  ~WorkersApart();
  WorkersApart(const WorkersApart&) = delete;
  WorkersApart& operator=(const WorkersApart&) = delete;

 private:
  const ServerProcess& server_;
  cpu_set_t all_;
};

/// What the service cannot be faster than: CreateJob writes 1 KiB and syncs it, WatchJob sends
/// `messages` prepared messages of `bytes`. Serves until SIGTERM.
int ServeBare(const std::filesystem::path& data_dir, int messages, int bytes);

}  // namespace contact
