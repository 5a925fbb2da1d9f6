#include "rpc/stream/backup_source.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <memory>
#include <string>

#include "test_server.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

// A reader of a file, without a stream.
class BackupSourceTest : public testing::Test {
 protected:
  BackupSourceTest()
      : reader_(std::make_shared<BackupReader>(
            executor_, [this] { ++wakes_; }, Lease())),
        source_(reader_->MakeSource()) {}

  std::shared_ptr<const void> Lease() {
    busy_ = true;
    return {this, [this](const void*) { busy_ = false; }};
  }

  std::unique_ptr<BackupFile> File(const std::string& bytes) {
    const std::string path = folder_.path() / "file";
    std::ofstream(path, std::ios::binary) << bytes;
    return BackupFile::Adopt(path).value();
  }

  // Waits for a wake, and takes what there is.
  StreamStep Take(v1::BackupChunk* chunk) {
    EXPECT_TRUE(Eventually([&] { return wakes_ > taken_; }));
    ++taken_;
    return source_->Read(chunk);
  }

  const TempDirectory folder_;
  std::atomic<bool> busy_ = false;
  std::atomic<int> wakes_ = 0;
  int taken_ = 0;
  Executor executor_;
  std::shared_ptr<BackupReader> reader_;
  std::unique_ptr<StreamSource<v1::BackupChunk>> source_;
};

TEST_F(BackupSourceTest, NothingIsSentBeforeTheCopyIsThere) {
  v1::BackupChunk chunk;
  const StreamStep step = source_->Read(&chunk);
  EXPECT_FALSE(step.has_message);
  EXPECT_FALSE(step.ended || step.error);
}

TEST_F(BackupSourceTest, ChunksMakeUpTheFileAndTheLastOneEndsTheStream) {
  const std::string bytes(600'000, 'x');
  reader_->Begin(File(bytes));
  std::string read;
  for (int i = 0; i < 3; ++i) {
    v1::BackupChunk chunk;
    const StreamStep step = Take(&chunk);
    ASSERT_TRUE(step.has_message);
    EXPECT_EQ(chunk.offset(), static_cast<std::int64_t>(read.size()));
    read += chunk.data();
    EXPECT_EQ(step.ended, i == 2);
  }
  EXPECT_EQ(read, bytes);
}

TEST_F(BackupSourceTest, OnlyOneChunkIsReadAhead) {
  reader_->Begin(File(std::string(2'000'000, 'x')));
  EXPECT_TRUE(Eventually([&] { return wakes_ == 1; }));
  executor_.Stop();
  EXPECT_EQ(wakes_, 1);
}

TEST_F(BackupSourceTest, FailedCopyEndsTheStreamWithItsError) {
  reader_->Begin(absl::UnavailableError("the disk failed"));
  v1::BackupChunk chunk;
  const StreamStep step = Take(&chunk);
  EXPECT_FALSE(step.has_message);
  ASSERT_TRUE(step.error);
  EXPECT_EQ(step.error->reason, "STORE_FAILED");
}

TEST_F(BackupSourceTest, StreamThatEndsStopsTheCopyAndFreesTheServerWhenItHasStopped) {
  EXPECT_FALSE(reader_->stop_token().stop_requested());
  source_.reset();
  EXPECT_TRUE(reader_->stop_token().stop_requested());
  EXPECT_TRUE(busy_) << "the store still copies";
  reader_->Begin(absl::CancelledError());
  EXPECT_FALSE(busy_);
}

TEST_F(BackupSourceTest, ServerIsBusyUntilTheStreamHasEnded) {
  reader_->Begin(File("bytes"));
  v1::BackupChunk chunk;
  EXPECT_TRUE(Take(&chunk).ended);
  EXPECT_TRUE(busy_);
  source_.reset();
  EXPECT_FALSE(busy_);
}

}  // namespace
}  // namespace contact
