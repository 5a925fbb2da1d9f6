#pragma once

#include <unistd.h>

#include <utility>

namespace contact {

/// Owns an open file descriptor, or none (-1). Closes it when destroyed. Errors of close are
/// ignored: who must know synchronises before.
class FileDescriptor {
 public:
  /// Takes over `fd`; any negative number, such as what open() returns on failure, is none.
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  ~FileDescriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(other.Release()) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  /// Whether there is one.
  bool valid() const { return fd_ >= 0; }
  /// The descriptor, still owned; negative if there is none.
  int get() const { return fd_; }
  /// Gives the descriptor away: the caller closes it. Owns none from then on.
  int Release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

}  // namespace contact
