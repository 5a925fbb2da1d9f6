#include "base/reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace contact {
namespace {

// A piece of the reserve, so that a disk without space for all of it has some.
constexpr std::int64_t kPiece = 1 << 20;

}  // namespace

Reserve::Reserve(const std::filesystem::path& file, std::int64_t bytes)
    : bytes_(bytes),
      file_(bytes > 0 ? ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600)
                      : -1) {
  Take();
}

bool Reserve::Give() {
  if (held_ == 0 || ::ftruncate(file_.get(), 0) != 0) return false;
  held_ = 0;
  return true;
}

void Reserve::Take() {
  while (file_.valid() && held_ < bytes_) {
    const std::int64_t piece = std::min(kPiece, bytes_ - held_);
    if (::posix_fallocate(file_.get(), held_, piece) != 0) return;
    held_ += piece;
  }
}

}  // namespace contact
