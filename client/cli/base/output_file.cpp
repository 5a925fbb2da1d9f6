#include "cli/base/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cli/base/failure.h"

namespace contact::cli {
namespace {

[[noreturn]] void Fail(const std::string& path) {
  throw Failure(ExitCode::kLocal, fmt::format("{}: {}", path.empty() ? "standard output" : path,
                                              std::generic_category().message(errno)));
}

}  // namespace

void RequireWritable(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(path, error)) {
    errno = EISDIR;
    Fail(path);
  }
  if (access(path.c_str(), W_OK) == 0) return;
  if (errno != ENOENT) Fail(path);
  const fs::path folder = fs::path(path).parent_path();
  if (access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) != 0) Fail(path);
}

OutputFile::OutputFile(const std::string& path)
    : path_(path), file_(path.empty() ? stdout : std::fopen(path.c_str(), "wb")) {
  if (file_ == nullptr) Fail(path_);
  constexpr std::size_t kBuffer = 1 << 16;  // Writers of tables write row by row.
  if (file_ != stdout) std::setvbuf(file_, nullptr, _IOFBF, kBuffer);
}

OutputFile::~OutputFile() {
  if (file_ != nullptr && file_ != stdout) std::fclose(file_);
}

void OutputFile::Close() {
  std::FILE* const file = std::exchange(file_, nullptr);
  const bool broken = std::ferror(file) != 0;
  if ((file == stdout ? std::fflush(file) : std::fclose(file)) != 0 || broken) Fail(path_);
}

}  // namespace contact::cli
