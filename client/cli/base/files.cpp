#include "cli/base/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "base/replace_file.h"
#include "cli/base/failure.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& path) {
  throw Failure(ExitCode::kLocal, fmt::format("{}: {}", path.empty() ? "standard output" : path,
                                              std::generic_category().message(errno)));
}

// False if the stream cannot be read, as that of a folder. An empty one can.
// Reads little more than `most` bytes.
bool ReadAll(std::istream& stream, std::size_t most, std::string* text) {
  if (!stream) return false;
  std::array<char, 1 << 16> block;
  while (stream.read(block.data(), block.size()), stream.gcount() > 0) {
    text->append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text->size() > most) return true;
  }
  return stream.eof() && !stream.bad();
}

}  // namespace

void RequireWritable(const std::string& path) {
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

std::string ReadText(const std::string& path, std::size_t most) {
  std::string text;
  std::ifstream file;
  if (path != "-") file.open(path, std::ios::binary);
  if (!ReadAll(path == "-" ? std::cin : file, most, &text)) {
    throw Failure(ExitCode::kLocal,
                  fmt::format("cannot read {}: {}", path, std::generic_category().message(errno)));
  }
  if (text.size() > most) {
    throw Failure(ExitCode::kLocal, fmt::format("{} has more than {} MiB", path, most >> 20));
  }
  return text;
}

void WriteText(const std::string& text, const std::string& path) {
  OutputFile file(path);
  std::fwrite(text.data(), 1, text.size(), file.get());
  file.Close();
}

void ReplaceText(const std::string& text, const std::string& path, mode_t mode) {
  if (const std::error_code error = ReplaceFile(path, text, mode)) {
    throw Failure(ExitCode::kLocal, fmt::format("cannot write {}: {}", path, error.message()));
  }
}

std::vector<std::string> LinesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "contactctl-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw Failure(ExitCode::kLocal, "cannot make " + name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace contact::cli
