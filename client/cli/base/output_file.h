#pragma once

#include <cstdio>
#include <string>

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

}  // namespace contact::cli
