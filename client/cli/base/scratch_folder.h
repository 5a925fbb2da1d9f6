#pragma once

#include <filesystem>

namespace contact::cli {

/// A folder of its own below the system's folder for such; gone with this object. Throws Failure
/// (kLocal) if there can be none.
class ScratchFolder {
 public:
  ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace contact::cli
