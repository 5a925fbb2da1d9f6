#include "storage/postgres/parameters.h"

#include <cstddef>
#include <utility>

namespace contact::postgres {
namespace {

// Types of elements, of PostgreSQL's pg_type.
constexpr std::int64_t kBytea = 17;
constexpr std::int64_t kBigint = 20;
constexpr std::int64_t kText = 25;

// Appends the `size` lowest bytes of a number, the highest first.
void Append(std::string* to, std::int64_t value, int size) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
    *to += static_cast<char>(value >> shift & 0xff);
  }
}

std::string ArrayHead(std::size_t count, std::int64_t type) {
  constexpr int kWord = 4;
  std::string bytes;
  Append(&bytes, count > 0, kWord);  // Dimensions.
  Append(&bytes, 0, kWord);          // No element is NULL.
  Append(&bytes, type, kWord);
  if (count == 0) return bytes;
  Append(&bytes, static_cast<std::int64_t>(count), kWord);
  Append(&bytes, 1, kWord);  // Number of the first element.
  return bytes;
}

void AppendElement(std::string* to, const std::string& bytes) {
  Append(to, static_cast<std::int64_t>(bytes.size()), 4);
  to->append(bytes);
}

}  // namespace

Parameters& Parameters::Integer(std::int64_t value) {
  std::string bytes;
  Append(&bytes, value, 8);
  return Bytes(std::move(bytes));
}

Parameters& Parameters::Boolean(bool value) {
  return Bytes(std::string(1, static_cast<char>(value)));
}

Parameters& Parameters::Bytes(std::string value) {
  values_.emplace_back(std::move(value));
  return *this;
}

Parameters& Parameters::Null() {
  values_.emplace_back();
  return *this;
}

Parameters& Parameters::Integers(const std::vector<std::int64_t>& values) {
  std::string bytes = ArrayHead(values.size(), kBigint);
  for (const std::int64_t value : values) {
    Append(&bytes, 8, 4);
    Append(&bytes, value, 8);
  }
  return Bytes(std::move(bytes));
}

Parameters& Parameters::Texts(const std::vector<std::string>& values) {
  std::string bytes = ArrayHead(values.size(), kText);
  for (const std::string& value : values) AppendElement(&bytes, value);
  return Bytes(std::move(bytes));
}

Parameters& Parameters::Blobs(const std::vector<const std::string*>& values) {
  std::string bytes = ArrayHead(values.size(), kBytea);
  for (const std::string* value : values) AppendElement(&bytes, *value);
  return Bytes(std::move(bytes));
}

std::vector<const char*> Parameters::values() const {
  std::vector<const char*> values;
  values.reserve(values_.size());
  for (const auto& value : values_) values.push_back(value ? value->data() : nullptr);
  return values;
}

std::vector<int> Parameters::lengths() const {
  std::vector<int> lengths;
  lengths.reserve(values_.size());
  for (const auto& value : values_) lengths.push_back(value ? static_cast<int>(value->size()) : 0);
  return lengths;
}

std::size_t Parameters::bytes() const {
  std::size_t bytes = 0;
  for (const auto& value : values_) bytes += value ? value->size() : 0;
  return bytes;
}

}  // namespace contact::postgres
