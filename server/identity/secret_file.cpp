#include "identity/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "base/file_descriptor.h"

namespace contact {
namespace {

constexpr std::size_t kMostSecretBytes = 1 << 20;
constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;

// The folder in which others may replace the file, or what it is a link to; empty: none.
std::string ReplaceableIn(const std::filesystem::path& file) {
  std::error_code error;
  for (const auto& path :
       {std::filesystem::absolute(file, error), std::filesystem::canonical(file, error)}) {
    struct stat folder = {};
    const bool found = ::stat(path.parent_path().c_str(), &folder) == 0;
    const bool open = (folder.st_mode & kOthersWrite) != 0 && (folder.st_mode & S_ISVTX) == 0;
    if (!found || open) return path.parent_path().string();
  }
  return "";
}

bool Read(const std::filesystem::path& file, mode_t refused, std::string* text,
          std::string* mistake) {
  const FileDescriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status = {};
  if (!in.valid() || ::fstat(in.get(), &status) != 0) {
    *mistake = "cannot read " + file.string() + ": " + std::generic_category().message(errno);
    return false;
  }
  if (!S_ISREG(status.st_mode)) {
    *mistake = file.string() + " is no file";
    return false;
  }
  if ((status.st_mode & refused) != 0) {
    const bool secret = (refused & S_IROTH) != 0;
    *mistake = file.string() + (secret ? " can be read or changed by others; chmod 600 it"
                                       : " can be changed by others; chmod go-w it");
    return false;
  }
  const std::string folder = refused == 0 ? "" : ReplaceableIn(file);
  if (!folder.empty()) {
    *mistake = file.string() + " can be replaced by others; chmod go-w " + folder;
    return false;
  }
  text->clear();
  std::array<char, 4096> part;
  for (ssize_t n; (n = ::read(in.get(), part.data(), part.size())) > 0;) {
    text->append(part.data(), static_cast<std::size_t>(n));
    if (text->size() <= kMostSecretBytes) continue;
    *mistake = file.string() + " is larger than 1 MiB";
    return false;
  }
  return true;
}

}  // namespace

bool ReadTextFile(const std::filesystem::path& file, std::string* text, std::string* mistake) {
  return Read(file, 0, text, mistake);
}

bool ReadTrustedFile(const std::filesystem::path& file, std::string* text, std::string* mistake) {
  return Read(file, kOthersWrite, text, mistake);
}

bool ReadSecretFile(const std::filesystem::path& file, std::string* text, std::string* mistake) {
  return Read(file, kOthersWrite | S_IROTH, text, mistake);
}

}  // namespace contact
