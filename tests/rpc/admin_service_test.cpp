#include "rpc/admin_service.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/digest.h"
#include "contact/v1/admin_service.grpc.pb.h"
#include "rpc/test_server.h"

namespace contact {
namespace {

using namespace std::chrono_literals;

/// A Backup call of one client.
struct BackupStream {
  explicit BackupStream(const TestServer& server)
      : stub(v1::AdminService::NewStub(server.Connect())),
        reader(stub->Backup(&context, v1::BackupRequest())) {}

  /// Reads to the end.
  grpc::Status ReadAll() {
    for (v1::BackupChunk chunk; reader->Read(&chunk);) chunks.push_back(chunk);
    return reader->Finish();
  }

  grpc::ClientContext context;
  std::unique_ptr<v1::AdminService::Stub> stub;
  std::unique_ptr<grpc::ClientReader<v1::BackupChunk>> reader;
  std::vector<v1::BackupChunk> chunks;
};

// A megabyte of trajectory or more, far more than a stream takes ahead of its reader.
void Fill(TestServer& server) {
  v1::Scenario scenario = Collision();
  scenario.mutable_output()->set_sample_interval_s(4e-8);
  const std::string name = server.Create(scenario);
  ASSERT_TRUE(Eventually([&] {
    v1::GetJobRequest request;
    request.set_name(name);
    grpc::ClientContext context;
    v1::Job job;
    return server.stub().GetJob(&context, request, &job).ok() && job.state() == v1::Job::SUCCEEDED;
  }));
}

// A call that has begun to send, to a client that reads no more than the first chunk.
void ReadFirst(BackupStream& stream) {
  v1::BackupChunk chunk;
  ASSERT_TRUE(stream.reader->Read(&chunk));
}

bool CanBackUp(const TestServer& server) { return BackupStream(server).ReadAll().ok(); }

TEST(AdminServiceTest, BackupIsTheWholeFileInCheckedChunks) {
  TestServer server;
  Fill(server);
  BackupStream stream(server);
  const grpc::Status status = stream.ReadAll();
  ASSERT_TRUE(status.ok()) << status.error_message();
  ASSERT_GT(stream.chunks.size(), 3U);
  std::string file;
  for (const v1::BackupChunk& chunk : stream.chunks) {
    EXPECT_EQ(chunk.offset(), static_cast<std::int64_t>(file.size()));
    EXPECT_LE(chunk.data().size(), 256U * 1024);
    EXPECT_EQ(chunk.crc32c(), Crc32c(chunk.data()));
    const bool last = &chunk == &stream.chunks.back();
    EXPECT_EQ(chunk.sha256().size(), last ? 32U : 0U);
    file += chunk.data();
    EXPECT_EQ(chunk.total_bytes(), last ? static_cast<std::int64_t>(file.size()) : 0);
  }
  Sha256 digest;
  digest.Add(file);
  EXPECT_EQ(stream.chunks.back().sha256(), digest.Finish());
  EXPECT_EQ(file.substr(0, 15), "SQLite format 3");
}

TEST(AdminServiceTest, OneBackupIsMadeAtATime) {
  TestServer server;
  Fill(server);
  BackupStream first(server);
  ReadFirst(first);
  const grpc::Status refused = BackupStream(server).ReadAll();
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(Reason(refused), "BACKUP_RUNNING");
  EXPECT_TRUE(first.ReadAll().ok());
  EXPECT_TRUE(CanBackUp(server));
}

TEST(AdminServiceTest, ClientThatLeavesMakesRoomForTheNext) {
  TestServer server;
  Fill(server);
  BackupStream first(server);
  ReadFirst(first);
  first.context.TryCancel();
  EXPECT_TRUE(Eventually([&] { return CanBackUp(server); }));
}

TEST(AdminServiceTest, ClientThatStallsIsDropped) {
  TestServer server({.write_stall = 100ms});
  Fill(server);
  BackupStream first(server);
  ReadFirst(first);
  EXPECT_TRUE(Eventually([&] { return CanBackUp(server); }));
  EXPECT_EQ(first.ReadAll().error_code(), grpc::StatusCode::CANCELLED);
}

TEST(AdminServiceTest, BackupDoesNotHoldUpTheShutdown) {
  TestServer server;
  Fill(server);
  BackupStream stalled(server);
  ReadFirst(stalled);
  server.grpc().Shutdown(10ms);
  EXPECT_FALSE(stalled.ReadAll().ok());
}

TEST(AdminServiceTest, BackupCountsAsAStreamOfItsPeer) {
  TestServer server({.calls = {.max_watchers_per_peer = 1}});
  Fill(server);
  BackupStream first(server);
  ReadFirst(first);
  const grpc::Status refused = BackupStream(server).ReadAll();
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(Reason(refused), "WATCHER_LIMIT");
}

// Values from RFC 3720, B.4, and FIPS 180-4's example.
TEST(DigestTest, ChecksumsAreTheOnesNamedInTheContract) {
  EXPECT_EQ(Crc32c(std::string(32, '\0')), 0x8A9136AAU);
  EXPECT_EQ(Crc32c(std::string(32, '\xff')), 0x62A8AB43U);
  EXPECT_EQ(Crc32c("123456789"), 0xE3069283U);
  Sha256 digest;
  digest.Add("a");
  digest.Add("bc");
  EXPECT_EQ(digest.Finish().substr(0, 4), "\xba\x78\x16\xbf");
}

}  // namespace
}  // namespace contact
