#pragma once

#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contact {

// The values of a column of FrameChunk or Series: IEEE 754 doubles, little-endian, one after the
// other.
static_assert(std::endian::native == std::endian::little, "columns are little-endian");

/// The bytes of one column of a table that lies row by row, `width` values a row.
inline std::string ColumnBytes(std::span<const double> rows, std::size_t width,
                               std::size_t column) {
  std::string bytes(rows.size() / width * sizeof(double), '\0');
  for (std::size_t row = 0; row < rows.size() / width; ++row) {
    std::memcpy(&bytes[row * sizeof(double)], &rows[row * width + column], sizeof(double));
  }
  return bytes;
}

/// The value at this place of a column that has it.
inline double DoubleAt(std::string_view bytes, std::size_t place) {
  double value = 0;
  std::memcpy(&value, bytes.data() + place * sizeof value, sizeof value);
  return value;
}

/// Appends the values of a column. Bytes past the last whole double are ignored.
inline void AppendDoubles(std::string_view bytes, std::vector<double>* values) {
  const std::size_t before = values->size();
  values->resize(before + bytes.size() / sizeof(double));
  if (values->size() == before) return;
  std::memcpy(values->data() + before, bytes.data(), (values->size() - before) * sizeof(double));
}

/// The values of a column.
inline std::vector<double> Doubles(std::string_view bytes) {
  std::vector<double> values;
  AppendDoubles(bytes, &values);
  return values;
}

}  // namespace contact
