#pragma once

#include <cstdio>
#include <string>

namespace contact::cli {

/// A file that is written, or the standard output for an empty path. Throws Failure (kLocal) if
/// it cannot be.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  std::FILE* get() const { return file_; }

  /// Tells whether everything has been written.
  void Close();

 private:
  std::string path_;
  std::FILE* file_;
};

}  // namespace contact::cli
