#include "rpc/grpc_server.h"

#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>

#include <string>

#include "test_server.h"

namespace contact {
namespace {

// Calls a method by name with one message of raw bytes; returns the raw answer, or the status.
struct RawAnswer {
  grpc::Status status;
  std::string bytes;
};

RawAnswer CallRaw(const TestServer& server, const std::string& method, const std::string& bytes) {
  grpc::GenericStub stub(server.Connect());
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  grpc::CompletionQueue queue;
  void* tag = nullptr;
  bool ok = false;
  const auto call = stub.PrepareCall(&context, method, &queue);
  call->StartCall(nullptr);
  queue.Next(&tag, &ok);
  const grpc::Slice slice(bytes);
  call->WriteLast(grpc::ByteBuffer(&slice, 1), {}, nullptr);
  queue.Next(&tag, &ok);
  RawAnswer answer;
  grpc::ByteBuffer buffer;
  call->Read(&buffer, nullptr);
  queue.Next(&tag, &ok);
  grpc::Slice flat;
  if (ok && buffer.DumpToSingleSlice(&flat).ok()) {
    answer.bytes.assign(reinterpret_cast<const char*>(flat.begin()), flat.size());
  }
  context.TryCancel();  // Reflection would wait for more.
  call->Finish(&answer.status, nullptr);
  queue.Next(&tag, &ok);
  return answer;
}

// grpc.health.v1.HealthCheckResponse on the wire.
const std::string kServing = "\x08\x01";
const std::string kNotServing = "\x08\x02";

std::string Health(const TestServer& server, const std::string& service) {
  const std::string request = "\x0a" + std::string(1, static_cast<char>(service.size())) + service;
  return CallRaw(server, "/grpc.health.v1.Health/Check", request).bytes;
}

TEST(GrpcServerTest, HealthTurnsNotServingOnDrain) {
  TestServer server;
  EXPECT_EQ(Health(server, ""), kServing);
  EXPECT_EQ(Health(server, "contact.v1.JobService"), kServing);
  server.grpc().Drain();
  EXPECT_EQ(Health(server, ""), kNotServing);
  EXPECT_EQ(Health(server, "contact.v1.JobService"), kNotServing);
}

TEST(GrpcServerTest, ReflectionIsASwitch) {
  const std::string method = "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo";
  const std::string list_services = "\x3a\x01*";
  const TestServer open({.reflection = true});
  EXPECT_THAT(CallRaw(open, method, list_services).bytes,
              testing::HasSubstr("contact.v1.JobService"));
  const TestServer closed({.reflection = false});
  EXPECT_EQ(CallRaw(closed, method, list_services).bytes, "");
}

// Reflection's answer to a request for the file that defines a symbol.
std::string FileOf(const TestServer& server, const std::string& symbol) {
  const std::string request = "\x22" + std::string(1, static_cast<char>(symbol.size())) + symbol;
  return CallRaw(server, "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", request)
      .bytes;
}

TEST(GrpcServerTest, ReflectionDescribesEveryServiceThatItLists) {
  const TestServer server({.reflection = true});
  EXPECT_THAT(FileOf(server, "contact.v1.JobService"), testing::HasSubstr("CreateJobRequest"));
  EXPECT_THAT(FileOf(server, "contact.v1.AdminService"), testing::HasSubstr("BackupRequest"));
  EXPECT_THAT(FileOf(server, "grpc.health.v1.Health"), testing::HasSubstr("HealthCheckResponse"));
  EXPECT_THAT(FileOf(server, "grpc.reflection.v1alpha.ServerReflection"),
              testing::HasSubstr("ServerReflectionResponse"));
  EXPECT_THAT(FileOf(server, "contact.v1.None"), testing::Not(testing::HasSubstr("Request")));
}

TEST(GrpcServerTest, ChannelzIsASwitchThatIsOff) {
  const std::string method = "/grpc.channelz.v1.Channelz/GetServers";
  const TestServer open({.channelz = true});
  EXPECT_NE(CallRaw(open, method, "").bytes, "");
  const TestServer closed;
  EXPECT_EQ(CallRaw(closed, method, "").bytes, "");
}

}  // namespace
}  // namespace contact
