#pragma once

#include <cstdint>
#include <filesystem>

#include "base/file_descriptor.h"

namespace contact {

/// Space that is kept on the disk for the time when there is none: deleting needs some of it before
/// it frees any. Not thread-safe.
class Reserve {
 public:
  /// Takes `bytes`, or what the disk has of them. 0: keeps nothing.
  Reserve(const std::filesystem::path& file, std::int64_t bytes);

  /// Gives all of it back to the disk. False: there was none.
  bool Give();
  /// Takes what was given back, as far as the disk has it.
  void Take();

 private:
  const std::int64_t bytes_;
  /// Invalid: nothing is kept.
  FileDescriptor file_;
  /// Bytes of the file.
  std::int64_t held_ = 0;
};

}  // namespace contact
