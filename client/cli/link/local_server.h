#pragma once

#include <sys/types.h>

#include <string>

#include "cli/base/files.h"

namespace contact::cli {

/// A contactd of our own: on a free loopback port, with its data in a temporary folder. It ends
/// with this object, or with the thread that made it, and leaves nothing.
class LocalServer {
 public:
  /// Starts `program`, a path or a name to look for in the PATH, and waits until it listens. Throws
  /// Failure (kLocal) if it does not.
  explicit LocalServer(const std::string& program);
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  /// HOST:PORT.
  const std::string& address() const { return address_; }
  /// Where a browser finds it: http://HOST:PORT.
  std::string http_address() const;
  /// For signals and waitid with WNOWAIT: only this object may wait for its end.
  pid_t process() const { return process_; }

 private:
  /// The port that the server has written to `port_file`; empty if it ended before, or is too slow.
  std::string WaitForPort(const std::string& port_file) const;

  /// Holds the store and the file with the port.
  ScratchFolder folder_;
  pid_t process_ = -1;
  std::string address_;
};

/// The contactd beside this program, else the one of the same build, else the one in the PATH.
std::string FindContactd();

}  // namespace contact::cli
