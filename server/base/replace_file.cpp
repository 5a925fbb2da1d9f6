#include "base/replace_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "base/file_descriptor.h"

namespace contact {
namespace {

namespace fs = std::filesystem;

std::error_code LastError() { return {errno, std::generic_category()}; }

// A write of regular files may be cut short by a signal or a full disk.
std::error_code WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return LastError();
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return {};
}

// A draft that a crash has left is removed, and a link that somebody put there is not followed.
std::error_code WriteDraft(const fs::path& draft, std::string_view contents, mode_t mode) {
  ::unlink(draft.c_str());
  const FileDescriptor out(::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (!out.valid()) return LastError();
  return WriteAll(out.get(), contents);
}

std::error_code Synchronise(const fs::path& path, int flags) {
  const FileDescriptor opened(::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags));
  if (!opened.valid() || ::fsync(opened.get()) != 0) return LastError();
  return {};
}

}  // namespace

std::error_code ReplaceFile(const fs::path& file, std::string_view contents, mode_t mode) {
  const fs::path draft = file.string() + ".new";
  std::error_code error = WriteDraft(draft, contents, mode);
  if (!error) error = MoveIntoPlace(draft, file);
  if (error) ::unlink(draft.c_str());
  return error;
}

std::error_code MoveIntoPlace(const fs::path& draft, const fs::path& file) {
  if (const std::error_code error = Synchronise(draft, 0)) return error;
  if (::rename(draft.c_str(), file.c_str()) != 0) return LastError();
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  return Synchronise(folder, O_DIRECTORY);
}

}  // namespace contact
