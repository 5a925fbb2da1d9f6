#pragma once

#include <cstddef>
#include <vector>

#include "contact/v1/event.pb.h"

namespace contact {

/// The most bytes of a frame chunk as a message: a quarter of what clients of gRPC take unless they
/// are told otherwise.
inline constexpr std::size_t kMostChunkBytes = std::size_t{1} << 20;

/// The chunk, or chunks of `most_bytes` at most with its columns, in their order: each has the
/// first column, which is `time`, and one more at least.
std::vector<v1::FrameChunk> SplitColumns(v1::FrameChunk chunk,
                                         std::size_t most_bytes = kMostChunkBytes);

/// Puts chunks whose columns were split together again.
class ColumnJoiner {
 public:
  /// Takes the next chunk of a log. The chunk with all columns once it has the last of them, else
  /// null; valid until the next call and as long as `chunk`.
  const v1::FrameChunk* Add(const v1::FrameChunk& chunk);

 private:
  /// What has come of a chunk whose columns follow; without columns if there is none.
  v1::FrameChunk joined_;
};

}  // namespace contact
