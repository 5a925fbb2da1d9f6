#include "storage/backup_file.h"

#include <absl/strings/str_cat.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace contact {
namespace {

namespace fs = std::filesystem;

absl::Status Failed(const std::string& what) {
  return absl::UnavailableError(
      absl::StrCat("cannot ", what, " the backup: ", std::generic_category().message(errno)));
}

}  // namespace

absl::StatusOr<std::unique_ptr<BackupFile>> BackupFile::Adopt(const fs::path& path) {
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status = {};
  if (!file.valid() || ::fstat(file.get(), &status) != 0) return Failed("open");
  if (::unlink(path.c_str()) != 0) return Failed("unlink");
  return std::unique_ptr<BackupFile>(new BackupFile(std::move(file), status.st_size));
}

absl::StatusOr<std::string> BackupFile::Read(std::int64_t offset, std::size_t most) const {
  std::string bytes(std::min(most, static_cast<std::size_t>(size_ - offset)), '\0');
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::pread(file_.get(), bytes.data() + done, bytes.size() - done,
                              offset + static_cast<std::int64_t>(done));
    if (n == 0) errno = EIO;
    if (n <= 0) return Failed("read");
    done += static_cast<std::size_t>(n);
  }
  return bytes;
}

}  // namespace contact
