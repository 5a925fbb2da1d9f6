#include "cli/link/download.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <mutex>

#include "base/digest.h"
#include "cli/base/files.h"
#include "cli/link/fake_server.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

std::string Sha256Of(const std::string& bytes) {
  Sha256 digest;
  digest.Add(bytes);
  return digest.Finish();
}

// Sends an artifact in blocks of three bytes.
class ArtifactServer : public FakeServer {
 public:
  const std::string content = "the quick brown fox";
  std::string sha256 = Sha256Of(content);
  std::size_t most_blocks = 100;      ///< Of one call; then the stream breaks.
  std::int64_t damaged_offset = -1;   ///< The block there comes damaged, once.
  std::vector<std::int64_t> offsets;  ///< That were asked for.

 private:
  using Writer = grpc::ServerWriter<v1::ReadArtifactResponse>;

  grpc::Status ReadArtifact(grpc::ServerContext*, const v1::ReadArtifactRequest* request,
                            Writer* writer) override {
    auto offset = static_cast<std::size_t>(request->offset());
    offsets.push_back(request->offset());
    if (offset > content.size()) return {grpc::StatusCode::OUT_OF_RANGE, "past the end"};
    for (std::size_t block = 0; offset < content.size(); ++block, offset += 3) {
      if (block == most_blocks) return {grpc::StatusCode::UNAVAILABLE, "broken"};
      writer->Write(Block(offset));
    }
    v1::ReadArtifactResponse last;
    last.set_offset(static_cast<std::int64_t>(content.size()));
    last.set_crc32c(Crc32c(""));
    last.mutable_artifact()->set_name(request->artifact());
    last.mutable_artifact()->set_size_bytes(static_cast<std::int64_t>(content.size()));
    last.mutable_artifact()->set_sha256(sha256);
    writer->Write(last);
    return grpc::Status::OK;
  }

  v1::ReadArtifactResponse Block(std::size_t offset) {
    v1::ReadArtifactResponse message;
    message.set_offset(static_cast<std::int64_t>(offset));
    message.set_data(content.substr(offset, 3));
    message.set_crc32c(Crc32c(message.data()));
    if (message.offset() == damaged_offset) {
      message.mutable_data()->front() = '?';
      damaged_offset = -1;
    }
    return message;
  }
};

class DownloadTest : public testing::Test {
 protected:
  v1::Artifact Run() {
    Client client(server_.address(), 10s);
    DownloadOptions options{.job = "jobs/x", .artifact = "fox.txt", .path = path_, .deadline = {}};
    options.deadline = std::chrono::steady_clock::now() + 60s;
    options.patience = {.first_pause = 1ms, .longest_pause = 4ms};
    return Download(client, options);
  }

  ExitCode Refused() {
    try {
      Run();
    } catch (const Failure& failure) {
      return failure.code();
    }
    return ExitCode::kOk;
  }

  bool PartIsThere() const { return std::filesystem::exists(path_ + ".part"); }

  const TempDirectory folder_;
  const std::string path_ = folder_.path() / "fox.txt";
  ArtifactServer server_;
};

TEST_F(DownloadTest, FileHasTheBytesOfTheServer) {
  EXPECT_EQ(Run().name(), "fox.txt");
  EXPECT_EQ(ReadText(path_), server_.content);
  EXPECT_FALSE(PartIsThere());
}

TEST_F(DownloadTest, ABrokenStreamGoesOnWhereItWas) {
  server_.most_blocks = 2;
  Run();
  EXPECT_EQ(ReadText(path_), server_.content);
  EXPECT_THAT(server_.offsets, ElementsAre(0, 6, 12, 18));
}

TEST_F(DownloadTest, APartThatWasLeftIsNotFetchedAgain) {
  WriteText(server_.content.substr(0, 7), path_ + ".part");
  Run();
  EXPECT_EQ(ReadText(path_), server_.content);
  EXPECT_THAT(server_.offsets, ElementsAre(7));
}

TEST_F(DownloadTest, ADamagedBlockIsAskedForAgain) {
  server_.damaged_offset = 6;
  Run();
  EXPECT_EQ(ReadText(path_), server_.content);
  EXPECT_THAT(server_.offsets, ElementsAre(0, 6));
}

TEST_F(DownloadTest, WhatIsNotTheContentOfTheServerIsThrownAway) {
  for (const std::string& part : {std::string("another"), std::string(100, 'x')}) {
    WriteText(part, path_ + ".part");
    EXPECT_EQ(Refused(), ExitCode::kRunFailed);
    EXPECT_FALSE(PartIsThere());
    EXPECT_FALSE(std::filesystem::exists(path_));
  }
  server_.sha256 = Sha256Of("something else");
  EXPECT_EQ(Refused(), ExitCode::kRunFailed);
}

TEST_F(DownloadTest, AFileThatIsThereIsReplacedOnlyByTheWhole) {
  WriteText("before", path_);
  server_.sha256 = Sha256Of("something else");
  EXPECT_EQ(Refused(), ExitCode::kRunFailed);
  EXPECT_EQ(ReadText(path_), "before");
  server_.sha256 = Sha256Of(server_.content);
  Run();
  EXPECT_EQ(ReadText(path_), server_.content);
}

TEST_F(DownloadTest, AFolderThatIsMissingIsALocalFailure) {
  Client client(server_.address(), 10s);
  try {
    Download(client, {.job = "jobs/x", .artifact = "a", .path = "/no/such/a", .deadline = {}});
    FAIL();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kLocal);
  }
}

}  // namespace
}  // namespace contact::cli
