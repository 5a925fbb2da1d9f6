#pragma once

#include <filesystem>

namespace contact::cli {

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
