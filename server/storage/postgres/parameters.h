#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace contact::postgres {

/// The parameters of one statement, in order, in PostgreSQL's binary format.
class Parameters {
 public:
  /// A bigint.
  Parameters& Integer(std::int64_t value);
  /// A boolean.
  Parameters& Boolean(bool value);
  /// A text or bytea.
  Parameters& Bytes(std::string value);
  Parameters& Null();

  /// A bigint[].
  Parameters& Integers(const std::vector<std::int64_t>& values);
  /// A text[].
  Parameters& Texts(const std::vector<std::string>& values);
  /// A bytea[]. The strings outlive the call only.
  Parameters& Blobs(const std::vector<const std::string*>& values);

  int size() const { return static_cast<int>(values_.size()); }
  /// The value of each; null for NULL. Valid until the parameters change.
  std::vector<const char*> values() const;
  /// The bytes of each.
  std::vector<int> lengths() const;
  /// Of all of them together.
  std::size_t bytes() const;

 private:
  std::vector<std::optional<std::string>> values_;
};

}  // namespace contact::postgres
