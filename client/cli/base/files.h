#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace contact::cli {

/// Throws Failure (kLocal) if the file at `path` cannot be written or made, such as for lack of its
/// folder. Makes nothing: for checks before long work.
void RequireWritable(const std::string& path);

/// A file that is written, or the standard output if the path is empty. Closed at the latest with
/// this object.
class OutputFile {
 public:
  /// Opens the file and empties it. Throws Failure (kLocal) if that fails.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// The open file, for functions of C; null after Close.
  std::FILE* get() const { return file_; }

  /// Writes what is buffered and closes the file. Throws Failure (kLocal) if any write failed.
  void Close();

 private:
  std::string path_;
  /// Null once it is closed.
  std::FILE* file_;
};

/// Permission bits of a file with a secret.
inline constexpr mode_t kOwnerOnly = 0600;

/// The whole content of a file, any bytes; `-` is the standard input. Throws Failure (kLocal) if it
/// cannot be read, or has more bytes than `most`.
std::string ReadText(const std::string& path,
                     std::size_t most = std::numeric_limits<std::size_t>::max());

/// Replaces the content of a file; an empty path is the standard output. Throws Failure (kLocal) if
/// it cannot be written.
void WriteText(const std::string& text, const std::string& path);

/// The same, but whoever reads meanwhile, or after a crash, sees the old content or all of the new.
/// `mode` is the permission bits of the file before the umask.
void ReplaceText(const std::string& text, const std::string& path, mode_t mode = 0666);

/// The lines of a text without their ends. A last line without an end is one, too.
std::vector<std::string> LinesOf(const std::string& text);

/// A new folder that only this user can read, in the system's folder for temporary files. It is
/// removed with all its content when this object ends.
class ScratchFolder {
 public:
  /// Makes the folder. Throws Failure (kLocal) if that fails.
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  /// Absolute path of the folder.
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace contact::cli
