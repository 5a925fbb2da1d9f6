#include <gtest/gtest.h>

#include <string>

#include "test_server.h"

namespace contact {
namespace {

// Reads an artifact from an offset to its end.
grpc::Status ReadArtifact(TestServer& server, const std::string& job, const std::string& name,
                          std::int64_t offset, std::string* data, v1::Artifact* artifact) {
  v1::ReadArtifactRequest request;
  request.set_name(job);
  request.set_artifact(name);
  request.set_offset(offset);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  const auto reader = server.stub().ReadArtifact(&context, request);
  v1::ReadArtifactResponse message;
  while (reader->Read(&message)) {
    EXPECT_LE(message.data().size(), 262'144U);
    EXPECT_EQ(message.offset(), offset + static_cast<std::int64_t>(data->size()));
    *data += message.data();
    if (message.has_artifact()) *artifact = message.artifact();
  }
  return reader->Finish();
}

TEST(ArtifactStreamTest, TrajectoryComesInChunksAndEndsWithItsSize) {
  TestServer server;
  v1::Scenario scenario = Collision();
  scenario.mutable_output()->set_sample_interval_s(1e-6);
  const std::string job = server.Create(scenario);
  ASSERT_TRUE(Eventually([&] {
    std::string data;
    v1::Artifact artifact;
    return Reason(ReadArtifact(server, job, "cycles.csv", 0, &data, &artifact)) != "INVALID_STATE";
  }));
  std::string whole;
  v1::Artifact artifact;
  ASSERT_TRUE(ReadArtifact(server, job, "trajectory.csv", 0, &whole, &artifact).ok());
  EXPECT_EQ(artifact.size_bytes(), static_cast<std::int64_t>(whole.size()));
  EXPECT_GT(whole.size(), 300'000U);
  std::string rest;
  v1::Artifact again;
  ASSERT_TRUE(ReadArtifact(server, job, "trajectory.csv", 299'999, &rest, &again).ok());
  EXPECT_EQ(rest, whole.substr(299'999));
  EXPECT_EQ(again.sha256(), artifact.sha256());
}

TEST(ArtifactStreamTest, ErrorsAreThoseOfTheContract) {
  TestServer server;
  std::string data;
  v1::Artifact artifact;
  EXPECT_EQ(Reason(ReadArtifact(server, "jobs/none", "cycles.csv", 0, &data, &artifact)),
            "JOB_NOT_FOUND");
  EXPECT_EQ(Reason(ReadArtifact(server, "jobs/none", "cycles.csv", -1, &data, &artifact)),
            "OFFSET_OUT_OF_RANGE");
  const std::string job = server.Create(Endless());
  EXPECT_EQ(Reason(ReadArtifact(server, job, "cycles.csv", 0, &data, &artifact)), "INVALID_STATE");
  EXPECT_TRUE(Eventually([&] { return server.grpc().watchers() == 0; }));
}

}  // namespace
}  // namespace contact
