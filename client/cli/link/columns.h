#pragma once

#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

namespace contact::cli {

static_assert(std::endian::native == std::endian::little, "columns on the wire are little-endian");

/// Appends the values of a column of FrameChunk: `bytes` are doubles, little-endian and without
/// padding. Bytes past the last whole double are ignored.
inline void AppendDoubles(std::string_view bytes, std::vector<double>* values) {
  const std::size_t before = values->size();
  values->resize(before + bytes.size() / sizeof(double));
  if (values->size() == before) return;
  std::memcpy(values->data() + before, bytes.data(), (values->size() - before) * sizeof(double));
}

/// The values of a column of FrameChunk or Series.
inline std::vector<double> Doubles(std::string_view bytes) {
  std::vector<double> values;
  AppendDoubles(bytes, &values);
  return values;
}

}  // namespace contact::cli
