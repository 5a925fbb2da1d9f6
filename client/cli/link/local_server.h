#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace contact::cli {

/// A contactd of our own: on a free loopback port, with its data in a temporary folder. It ends
/// with this object, or with this process, and leaves nothing.
class LocalServer {
 public:
  /// Starts `program` and waits until it listens. Throws Failure (kLocal) if it does not.
  explicit LocalServer(const std::string& program);
  ~LocalServer();
  LocalServer(const LocalServer&) = delete;
  LocalServer& operator=(const LocalServer&) = delete;

  const std::string& address() const { return address_; }  ///< HOST:PORT
  pid_t process() const { return process_; }

 private:
  void End();
  std::string WaitForGreeting(int output);

  std::filesystem::path folder_;
  pid_t process_ = -1;
  std::string address_;
};

/// The contactd beside this program, else the one in the build or the PATH.
std::string FindContactd();

}  // namespace contact::cli
