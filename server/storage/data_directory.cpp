#include "storage/data_directory.h"

#include <absl/strings/str_cat.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace contact {
namespace {

namespace fs = std::filesystem;

absl::Status Failed(const std::string& what, const fs::path& path) {
  return absl::FailedPreconditionError(absl::StrCat("cannot ", what, " ", path.string(), ": ",
                                                    std::generic_category().message(errno)));
}

/// Closes a descriptor at the end of the scope.
struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

bool WriteAll(int fd, const std::string& text) {
  return ::write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

std::string ReadSome(int fd) {
  char text[64] = {};
  const ssize_t n = ::pread(fd, text, sizeof text - 1, 0);
  std::string read(text, n > 0 ? static_cast<std::size_t>(n) : 0);
  while (!read.empty() && read.back() == '\n') read.pop_back();
  return read;
}

bool TakeLock(int fd) {
  struct flock lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return ::fcntl(fd, F_OFD_SETLK, &lock) == 0;
}

}  // namespace

absl::StatusOr<DataDirectory> DataDirectory::Open(const fs::path& path) {
  std::error_code error;
  if (fs::create_directories(path, error); error) {
    return absl::FailedPreconditionError(
        absl::StrCat("cannot create data directory ", path.string(), ": ", error.message()));
  }
  const fs::path file = path / "lock";
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (fd < 0) return Failed("open", file);
  DataDirectory directory(path, fd);
  if (!TakeLock(fd)) {
    return absl::UnavailableError(absl::StrCat("data directory ", path.string(),
                                               " is in use by process ", ReadSome(fd),
                                               "; stop it, or choose another data directory"));
  }
  if (::ftruncate(fd, 0) != 0 || !WriteAll(fd, std::to_string(::getpid()) + "\n")) {
    return Failed("write", file);
  }
  return directory;
}

DataDirectory::DataDirectory(DataDirectory&& other) noexcept
    : path_(std::move(other.path_)), lock_(std::exchange(other.lock_, -1)) {}

DataDirectory::~DataDirectory() {
  if (lock_ >= 0) ::close(lock_);
}

bool DataDirectory::initialised() const { return fs::exists(path_ / "initialised"); }

absl::Status DataDirectory::MarkInitialised() const {
  const fs::path file = path_ / "initialised";
  const fs::path draft = path_ / "initialised.new";
  {
    const Descriptor out{::open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)};
    if (out.fd < 0 || !WriteAll(out.fd, "contactd.db belongs here\n") || ::fsync(out.fd) != 0) {
      return Failed("write", draft);
    }
  }
  if (::rename(draft.c_str(), file.c_str()) != 0) return Failed("write", file);
  const Descriptor folder{::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (folder.fd < 0 || ::fsync(folder.fd) != 0) return Failed("sync", path_);
  return absl::OkStatus();
}

}  // namespace contact
