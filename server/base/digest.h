#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace contact {

/// CRC-32C (Castagnoli) of bytes, as in BackupChunk.
std::uint32_t Crc32c(std::string_view bytes);

/// SHA-256 of bytes that come in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void Add(std::string_view bytes);
  /// The 32 bytes of the digest. Call it once, at the end.
  std::string Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace contact
