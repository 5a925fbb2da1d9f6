#pragma once

#include <cstddef>
#include <string_view>

namespace contact {

/// Rearranges columns of doubles such that a compressor finds like bytes beside like, without loss.
///
/// A column becomes the second differences between the bit patterns of its values, which are small
/// for smooth motion. Plane b, 0 ≤ b < 8, then holds byte b of the difference of every value of
/// every column, 0 being the lowest. Arithmetic is modulo 2^64, so NaN and −0 keep their bits.

/// Writes the planes of one column. `column` holds little-endian doubles. Byte b of value i goes to
/// `planes[b * stride + i]`; `stride` is the number of values of all columns together.
void SplitColumn(std::string_view column, std::size_t stride, char* planes);

/// The inverse of SplitColumn: writes the 8 · `count` bytes of a column with `count` values.
void JoinColumn(const char* planes, std::size_t stride, std::size_t count, char* column);

}  // namespace contact
