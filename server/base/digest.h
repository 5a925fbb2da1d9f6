#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace contact {

/// CRC-32C (Castagnoli) of bytes: polynomial 0x1EDC6F41, reflected, as BackupChunk.crc32c has it.
std::uint32_t Crc32c(std::string_view bytes);

/// HMAC-SHA-256 of the bytes with this key: 32 bytes, not hexadecimal. Throws std::runtime_error if
/// OpenSSL fails.
std::string HmacSha256(const std::string& key, std::string_view bytes);

/// SHA-256 of bytes that come in pieces. Throws std::runtime_error if OpenSSL fails. Not
/// thread-safe.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  /// Appends a piece; it may be empty.
  void Add(std::string_view bytes);
  /// The 32 bytes of the digest, not hexadecimal. Call it once, at the end.
  std::string Finish();

 private:
  // OpenSSL's context; hides its header.
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace contact
