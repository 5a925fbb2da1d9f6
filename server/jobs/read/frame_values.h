#pragma once

#include <algorithm>
#include <cstddef>

#include "contact/v1/event.pb.h"
#include "wire/column_bytes.h"

namespace contact {

/// True if each column of the chunk has a value for every sample.
inline bool IsWhole(const v1::FrameChunk& chunk) {
  const std::size_t bytes = static_cast<std::size_t>(chunk.samples()) * sizeof(double);
  return std::ranges::all_of(
      chunk.columns(), [bytes](const auto& column) { return column.values().size() == bytes; });
}

/// The value of the sample `row` of a column, which must have one.
inline double ValueAt(const v1::FrameChunk::Column& column, int row) {
  return DoubleAt(column.values(), static_cast<std::size_t>(row));
}

}  // namespace contact
