#include "wire/chunk_columns.h"

#include <utility>

namespace contact {
namespace {

// The most bytes of tag and length of a column.
constexpr std::size_t kColumnHead = 6;
// Bytes of `columns_follow`.
constexpr std::size_t kFollowBytes = 2;

}  // namespace

std::vector<v1::FrameChunk> SplitColumns(v1::FrameChunk chunk, std::size_t most_bytes) {
  std::vector<v1::FrameChunk> parts;
  if (chunk.ByteSizeLong() <= most_bytes || chunk.columns_size() < 2) {
    parts.push_back(std::move(chunk));
    return parts;
  }
  v1::FrameChunk head;
  head.set_first_sample(chunk.first_sample());
  head.set_samples(chunk.samples());
  *head.add_columns() = std::move(*chunk.mutable_columns(0));
  const std::size_t head_bytes = head.ByteSizeLong() + kFollowBytes;
  std::size_t bytes = most_bytes;
  for (int i = 1; i < chunk.columns_size(); ++i) {
    const std::size_t more = chunk.columns(i).ByteSizeLong() + kColumnHead;
    if (bytes + more > most_bytes) {
      if (!parts.empty()) parts.back().set_columns_follow(true);
      parts.push_back(head);
      bytes = head_bytes;
    }
    bytes += more;
    *parts.back().add_columns() = std::move(*chunk.mutable_columns(i));
  }
  return parts;
}

const v1::FrameChunk* ColumnJoiner::Add(const v1::FrameChunk& chunk) {
  const bool more = joined_.columns_follow() && joined_.first_sample() == chunk.first_sample();
  if (!more && !chunk.columns_follow()) {
    joined_.Clear();
    return &chunk;
  }
  if (more) {
    for (int i = 1; i < chunk.columns_size(); ++i) *joined_.add_columns() = chunk.columns(i);
    joined_.set_columns_follow(chunk.columns_follow());
  } else {
    joined_ = chunk;
  }
  return chunk.columns_follow() ? nullptr : &joined_;
}

}  // namespace contact
