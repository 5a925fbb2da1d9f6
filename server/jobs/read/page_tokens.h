#pragma once

#include <cstdint>
#include <string>
#include <utility>

namespace contact {

/// Hides the positions of pages in tokens. A position counts the jobs of all tenants, so a token is
/// one block of AES-128 under a key of its tenant: it tells nothing, and another tenant's cannot be
/// read. Thread-safe.
class PageTokens {
 public:
  /// Tokens made with the same `secret` are read by whoever knows it; it may have any length.
  explicit PageTokens(std::string secret) : secret_(std::move(secret)) {}

  /// The token of a position, 32 hexadecimal digits; empty for 0.
  std::string Seal(const std::string& tenant, std::int64_t position) const;
  /// The position of a token; 0 for an empty one, negative for one that was not made for the
  /// tenant.
  std::int64_t Open(const std::string& tenant, const std::string& token) const;

 private:
  const std::string secret_;
};

}  // namespace contact
