#include "rpc/grpc_server.h"

#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "client_socket.h"
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

TEST(GrpcServerTest, TwoServersCannotShareAPort) {
  TestServer first;
  GrpcServer second(first.jobs(), first.store(), {}, {});
  EXPECT_FALSE(second.Start(first.address()));
}

TEST(GrpcServerTest, BadAddressIsAnError) {
  TestServer first;
  GrpcServer second(first.jobs(), first.store(), {}, {});
  EXPECT_FALSE(second.Start("256.0.0.1:0"));
}

bool Answers(const std::string& target) {
  const auto stub =
      v1::JobService::NewStub(grpc::CreateChannel(target, grpc::InsecureChannelCredentials()));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  v1::ServerInfo info;
  return stub->GetServerInfo(&context, {}, &info).ok();
}

TEST(GrpcServerTest, ListensOnIpv6AndOnNames) {
  TestServer first;
  for (const std::string host : {"[::1]", "localhost"}) {
    GrpcServer server(first.jobs(), first.store(), {}, {});
    const auto port = server.Start(host + ":0");
    ASSERT_TRUE(port) << host;
    EXPECT_TRUE(Answers(host + ":" + std::to_string(*port)));
  }
}

TEST(GrpcServerTest, SocketFileIsForOwnerAndGroupAndForOneServer) {
  TestServer first;
  const TempDirectory folder;
  const std::string file = folder.path() / "socket";
  GrpcServer server(first.jobs(), first.store(), {}, {});
  ASSERT_EQ(server.Start("unix:" + file), 0);
  struct stat status = {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0660U);
  GrpcServer second(first.jobs(), first.store(), {}, {});
  EXPECT_FALSE(second.Start("unix:" + file));
  EXPECT_TRUE(Answers("unix:" + file));
  server.Shutdown(std::chrono::seconds(1));
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(GrpcServerTest, SilentConnectionIsClosed) {
  const TestServer server({.handshake_timeout = std::chrono::milliseconds(50)});
  ClientSocket silent(server.port());
  EXPECT_TRUE(silent.IsClosedByPeer());
}

TEST(GrpcServerTest, ConnectionsPastTheLimitAreRefused) {
  const TestServer server({.connections = {.in_all = 2, .per_peer = 2}});
  ClientSocket first(server.port());
  ClientSocket second(server.port());
  EXPECT_TRUE(Eventually([&] { return ClientSocket(server.port()).IsClosedByPeer(); }));
  first.Close();
  EXPECT_TRUE(Eventually([&] { return Answers(server.address()); }));
}

}  // namespace
}  // namespace contact
