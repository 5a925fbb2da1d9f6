#include "jobs/run/ending_runs.h"

#include <gtest/gtest.h>

#include <thread>

#include "jobs/run/log_writer.h"
#include "storage/sqlite/sqlite_store.h"
#include "testing/fake_sources.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

class EndingRunsTest : public testing::Test {
 protected:
  std::shared_ptr<LogWriter> Writer() {
    return std::make_shared<LogWriter>(*store_, clock_, LogWriter::Place{"jobs/a", 0, nullptr},
                                       std::make_shared<RunControl>(), std::stop_token());
  }

  TempDirectory directory_;
  std::unique_ptr<Store> store_ = *OpenSqlite(directory_.path());
  FakeClock clock_;
  EndingRuns endings_;
};

TEST_F(EndingRunsTest, ThereIsRoomForManySmallJobs) {
  for (int i = 0; i < 100; ++i) endings_.Add(Writer(), 1000);
  endings_.AwaitRoom({});
}

TEST_F(EndingRunsTest, OneThatTakesMuchIsWaitedFor) {
  const auto large = Writer();
  endings_.Add(large, 100 << 20);
  std::jthread worker([this](const std::stop_token&) { endings_.AwaitRoom({}); });
  endings_.Remove(large.get());
}

TEST_F(EndingRunsTest, ShutdownEndsTheWait) {
  endings_.Add(Writer(), 100 << 20);
  std::jthread worker([this](const std::stop_token& stop) { endings_.AwaitRoom(stop); });
}

TEST_F(EndingRunsTest, WriterIsLetGoOnceItIsRemoved) {
  auto writer = Writer();
  const std::weak_ptr<LogWriter> weak = writer;
  const LogWriter* const key = writer.get();
  endings_.Add(std::move(writer), 0);
  EXPECT_FALSE(weak.expired());
  endings_.Remove(key);
  endings_.Remove(key);
  EXPECT_TRUE(weak.expired());
}

}  // namespace
}  // namespace contact
