#include "wire/chunk_columns.h"

#include <gmock/gmock.h>

#include <string>

namespace contact {
namespace {

using testing::SizeIs;

v1::FrameChunk Chunk(int columns) {
  v1::FrameChunk chunk;
  chunk.set_first_sample(300);
  chunk.set_samples(2);
  for (int i = 0; i < columns; ++i) {
    v1::FrameChunk::Column& column = *chunk.add_columns();
    column.set_name(i > 0 ? "B" + std::to_string(i) + ".velocity" : "time");
    column.set_unit("m/s");
    column.set_values(std::string(16, static_cast<char>(i)));
  }
  return chunk;
}

TEST(SplitColumns, AChunkThatFitsStaysAsItIs) {
  const v1::FrameChunk chunk = Chunk(50);
  const auto parts = SplitColumns(chunk, chunk.ByteSizeLong());
  ASSERT_THAT(parts, SizeIs(1));
  EXPECT_EQ(parts[0].SerializeAsString(), chunk.SerializeAsString());
}

TEST(SplitColumns, NoPartIsLargerThanAskedForAndEachHasItsTimes) {
  for (const std::size_t most : {200U, 333U, 1000U}) {
    const auto parts = SplitColumns(Chunk(50), most);
    EXPECT_GT(parts.size(), 1U);
    for (const v1::FrameChunk& part : parts) {
      EXPECT_LE(part.ByteSizeLong(), most);
      EXPECT_EQ(part.first_sample(), 300);
      EXPECT_EQ(part.samples(), 2);
      EXPECT_EQ(part.columns(0).name(), "time");
      EXPECT_EQ(part.columns_follow(), &part != &parts.back());
    }
  }
}

TEST(SplitColumns, EachPartHasAColumnHoweverLarge) {
  EXPECT_THAT(SplitColumns(Chunk(5), 1), SizeIs(4));
  EXPECT_THAT(SplitColumns(Chunk(1), 1), SizeIs(1));
}

TEST(ColumnJoiner, MakesTheChunkThatWasSplit) {
  const v1::FrameChunk chunk = Chunk(50);
  ColumnJoiner joiner;
  for (const std::size_t most : {200U, 1U, 100'000U}) {
    const v1::FrameChunk* whole = nullptr;
    for (const v1::FrameChunk& part : SplitColumns(chunk, most)) {
      EXPECT_EQ(whole, nullptr);
      whole = joiner.Add(part);
      if (whole != nullptr) {
        EXPECT_EQ(whole->SerializeAsString(), chunk.SerializeAsString());
      }
    }
    EXPECT_NE(whole, nullptr);
  }
}

TEST(ColumnJoiner, ForgetsColumnsWhoseRestDoesNotCome) {
  v1::FrameChunk other = Chunk(3);
  other.set_first_sample(302);
  ColumnJoiner joiner;
  EXPECT_EQ(joiner.Add(SplitColumns(Chunk(50), 200)[0]), nullptr);
  EXPECT_EQ(joiner.Add(other), &other);
}

}  // namespace
}  // namespace contact
