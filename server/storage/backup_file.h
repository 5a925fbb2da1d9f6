#pragma once

#include <absl/status/statusor.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/file_descriptor.h"

namespace contact {

/// A copy of the store in a file without a name: the file is gone when this is. Safe to read from
/// any thread.
class BackupFile {
 public:
  /// Opens the file at `path` and removes its name. UNAVAILABLE: the disk failed.
  static absl::StatusOr<std::unique_ptr<BackupFile>> Adopt(const std::filesystem::path& path);

  /// In bytes.
  std::int64_t size() const { return size_; }

  /// The bytes from `offset` on, `most` of them or as many as there are. `offset` is at most
  /// size(). UNAVAILABLE: the disk failed, or the file is shorter than it was.
  absl::StatusOr<std::string> Read(std::int64_t offset, std::size_t most) const;

 private:
  BackupFile(FileDescriptor file, std::int64_t size) : file_(std::move(file)), size_(size) {}

  const FileDescriptor file_;
  const std::int64_t size_;
};

}  // namespace contact
