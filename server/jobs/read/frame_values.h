#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "contact/v1/event.pb.h"

namespace contact {

/// True if each column of the chunk has a value for every sample.
inline bool IsWhole(const v1::FrameChunk& chunk) {
  const std::size_t bytes = static_cast<std::size_t>(chunk.samples()) * sizeof(double);
  return std::ranges::all_of(
      chunk.columns(), [bytes](const auto& column) { return column.values().size() == bytes; });
}

/// The value of the sample `row` of a column, which must have one.
inline double ValueAt(const v1::FrameChunk::Column& column, int row) {
  double value;
  std::memcpy(&value, column.values().data() + static_cast<std::size_t>(row) * sizeof value,
              sizeof value);
  return value;
}

}  // namespace contact
