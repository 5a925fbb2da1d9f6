#include "storage/sqlite/data_directory.h"

#include <absl/strings/str_cat.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "base/replace_file.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

absl::Status Failed(const std::string& what, const fs::path& path,
                    std::error_code error = {errno, std::generic_category()}) {
  return absl::FailedPreconditionError(
      absl::StrCat("cannot ", what, " ", path.string(), ": ", error.message(), kGiveAccess));
}

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

// F_WRLCK keeps everybody out, F_RDLCK those who want F_WRLCK.
bool TakeLock(int fd, short type) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return ::fcntl(fd, F_OFD_SETLK, &lock) == 0;
}

absl::Status Held(const fs::path& path, int lock) {
  return absl::UnavailableError(absl::StrCat("data directory ", path.string(),
                                             " is in use by process ", ReadSome(lock),
                                             "; stop it, or choose another data directory"));
}

// Only its owner may look into a folder that is made here.
absl::Status MakeFolder(const fs::path& path) {
  std::error_code error;
  const bool made = fs::create_directories(path, error);
  if (made && !error) fs::permissions(path, fs::perms::owner_all, error);
  if (!error) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("cannot create data directory ", path.string(),
                                                    ": ", error.message(),
                                                    "; choose another with --data-dir"));
}

// Who may write into the folder may replace its files by links, or by others.
absl::Status CheckOwner(const fs::path& path) {
  struct stat found = {};
  if (::stat(path.c_str(), &found) != 0) return Failed("use", path);
  constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;
  if ((found.st_mode & kOthersWrite) != 0) {
    return absl::FailedPreconditionError(absl::StrCat("others may write into data directory ",
                                                      path.string(), "; chmod go-w ", path.string(),
                                                      ", or choose another with --data-dir"));
  }
  const uid_t self = ::geteuid();
  if (found.st_uid == self || found.st_uid == 0 || self == 0) return absl::OkStatus();
  errno = EPERM;
  return Failed("use", path);
}

}  // namespace

absl::StatusOr<DataDirectory> DataDirectory::Open(const fs::path& path) {
  if (absl::Status made = MakeFolder(path); !made.ok()) return made;
  if (absl::Status owned = CheckOwner(path); !owned.ok()) return owned;
  const fs::path file = path / "lock";
  FileDescriptor lock(::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600));
  if (!lock.valid()) return Failed("open", file);
  if (!TakeLock(lock.get(), F_WRLCK)) return Held(path, lock.get());
  if (::ftruncate(lock.get(), 0) != 0 || !WriteAll(lock.get(), std::to_string(::getpid()) + "\n")) {
    return Failed("write", file);
  }
  DataDirectory directory(path, std::move(lock));
  std::error_code missing;
  fs::remove(directory.backup_draft(), missing);
  return directory;
}

absl::StatusOr<DataDirectory> DataDirectory::OpenToRead(const fs::path& path) {
  if (!fs::is_directory(path)) {
    return absl::NotFoundError(absl::StrCat("there is no data directory ", path.string()));
  }
  FileDescriptor lock(::open((path / "lock").c_str(), O_RDONLY | O_CLOEXEC));
  // Without the file no contactd was ever here, such as beside a backup.
  if (!lock.valid() && errno != ENOENT) return Failed("open", path / "lock");
  if (lock.valid() && !TakeLock(lock.get(), F_RDLCK)) return Held(path, lock.get());
  return DataDirectory(path, std::move(lock));
}

bool DataDirectory::initialised() const { return fs::exists(path_ / "initialised"); }

absl::Status DataDirectory::MarkInitialised() const {
  const fs::path file = path_ / "initialised";
  const std::error_code error = ReplaceFile(file, "contactd.db belongs here\n", 0600);
  return error ? Failed("write", file, error) : absl::OkStatus();
}

}  // namespace contact
