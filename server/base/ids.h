#pragma once

#include <string>

namespace contact {

/// Identifiers that are never given twice, injected so that tests decide them. Thread-safe.
class IdSource {
 public:
  virtual ~IdSource() = default;

  /// A short identifier for people to read and type: lower-case letters and digits.
  virtual std::string NextId() = 0;

  /// A UUID in its usual form of 36 characters.
  virtual std::string NextUuid() = 0;
};

/// Random identifiers: 10 characters with 50 random bits, and UUIDs of version 4 (RFC 4122). Lives
/// as long as the process.
IdSource& RandomIds();

}  // namespace contact
