// The door on real sockets, with clients of gRPC, before a server that answers what a test wants.
#include <gmock/gmock.h>
#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/mutex.h"
#include "client_socket.h"
#include "contact/v1/job_service.grpc.pb.h"
#include "gateway/gateway.h"
#include "rpc/net/listener.h"
#include "rpc/net/peer.h"
#include "testing/await.h"
#include "testing/temp_directory.h"

namespace contact {
namespace {

using namespace std::chrono_literals;
using Names = std::multimap<std::string, std::string>;

// Echoes names, streams as many messages as an owner has letters, and remembers what it was told.
class EchoService final : public v1::JobService::Service {
 public:
  std::atomic<int> streaming = 0;

  // Of the last GetJob.
  Names metadata() const {
    const MutexLock lock(mutex_);
    return metadata_;
  }

 private:
  grpc::Status GetJob(grpc::ServerContext* context, const v1::GetJobRequest* request,
                      v1::Job* job) override {
    Names names;
    for (const auto& [name, value] : context->client_metadata()) {
      names.emplace(std::string(name.data(), name.size()), std::string(value.data(), value.size()));
    }
    {
      const MutexLock lock(mutex_);
      metadata_ = std::move(names);
    }
    context->AddInitialMetadata("x-head-bin", std::string("\0\xff", 2));
    context->AddTrailingMetadata("x-tail", "end");
    if (request->name() == "fail") {
      return {grpc::FAILED_PRECONDITION, "bad \xc3\xbc % text\n", std::string("\x08\x09\0", 3)};
    }
    job->set_name(request->name());
    return grpc::Status::OK;
  }
  grpc::Status WatchJob(grpc::ServerContext* context, const v1::WatchJobRequest* request,
                        grpc::ServerWriter<v1::WatchJobResponse>* writer) override {
    ++streaming;
    v1::WatchJobResponse response;
    response.mutable_snapshot()->set_name(std::string(request->name().size(), 'x'));
    const bool endless = request->after_sequence() == 0;
    for (std::uint64_t i = 0; endless || i < request->after_sequence(); ++i) {
      if (!writer->Write(response)) break;
    }
    --streaming;
    return context->IsCancelled() ? grpc::Status::CANCELLED : grpc::Status::OK;
  }

  mutable Mutex mutex_;
  Names metadata_ ABSL_GUARDED_BY(mutex_);
};

class DoorTest : public testing::Test {
 protected:
  DoorTest() {
    grpc::ServerBuilder builder;
    builder.RegisterService(&service_);
    builder.SetMaxReceiveMessageSize(-1);
    server_ = builder.BuildAndStart();
  }
  void Open(GatewayOptions options = {}, const std::string& address = "127.0.0.1:0") {
    Listener listener = OpenListener(address);
    ASSERT_FALSE(listener.sockets.empty());
    port_ = listener.port;
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(-1);
    door_ = std::make_unique<Gateway>(threads_, std::move(listener),
                                      server_->InProcessChannel(arguments), std::move(options));
  }
  std::unique_ptr<v1::JobService::Stub> Stub(const std::string& target = "") const {
    grpc::ChannelArguments arguments;
    arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
    arguments.SetInt(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, 64 << 10);
    arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
    arguments.SetMaxReceiveMessageSize(-1);
    return v1::JobService::NewStub(
        grpc::CreateCustomChannel(target.empty() ? "127.0.0.1:" + std::to_string(port_) : target,
                                  grpc::InsecureChannelCredentials(), arguments));
  }
  static bool Answers(v1::JobService::Stub& stub, const std::string& name = "a") {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + kPatience);
    v1::GetJobRequest request;
    request.set_name(name);
    v1::Job job;
    return stub.GetJob(&context, request, &job).ok() && job.name() == name;
  }

  EchoService service_;
  std::unique_ptr<grpc::Server> server_;
  GatewayThreads threads_;
  std::unique_ptr<Gateway> door_;
  int port_ = 0;
};

TEST_F(DoorTest, MessagesOfAnySizeComeBack) {
  Open({.max_body_bytes = 8 << 20});
  const auto stub = Stub();
  for (const std::size_t size : {0U, 1U, 65'000U, 66'000U, 300'000U, 8'000'000U}) {
    EXPECT_TRUE(Answers(*stub, std::string(size, 'n'))) << size;
  }
}

TEST_F(DoorTest, AMessageThatIsTooLargeIsExhausted) {
  Open({.max_body_bytes = 1 << 20});
  grpc::ClientContext context;
  v1::GetJobRequest request;
  request.set_name(std::string(2 << 20, 'n'));
  v1::Job job;
  EXPECT_EQ(Stub()->GetJob(&context, request, &job).error_code(), grpc::RESOURCE_EXHAUSTED);
}

TEST_F(DoorTest, CompressedMessagesAreRefused) {
  Open();
  for (const auto algorithm : {GRPC_COMPRESS_GZIP, GRPC_COMPRESS_DEFLATE}) {
    grpc::ClientContext context;
    context.set_compression_algorithm(algorithm);
    v1::GetJobRequest request;
    request.set_name(std::string(10'000, 'n'));
    v1::Job job;
    EXPECT_EQ(Stub()->GetJob(&context, request, &job).error_code(), grpc::UNIMPLEMENTED);
  }
}

TEST_F(DoorTest, ErrorsMetadataAndTrailersGoThrough) {
  Open();
  grpc::ClientContext context;
  context.AddMetadata("x-text", "a b");
  context.AddMetadata("x-bytes-bin", std::string("\x01\0\xfe", 3));
  context.AddMetadata(kPeerHeader, "ipv4:8.8.8.8:1");
  v1::GetJobRequest request;
  request.set_name("fail");
  v1::Job job;
  const grpc::Status status = Stub()->GetJob(&context, request, &job);
  EXPECT_EQ(status.error_code(), grpc::FAILED_PRECONDITION);
  EXPECT_EQ(status.error_message(), "bad \xc3\xbc % text\n");
  EXPECT_EQ(status.error_details(), std::string("\x08\x09\0", 3));
  EXPECT_EQ(context.GetServerTrailingMetadata().find("x-tail")->second, "end");
  const Names told = service_.metadata();
  EXPECT_EQ(told.find("x-text")->second, "a b");
  EXPECT_EQ(told.find("x-bytes-bin")->second, std::string("\x01\0\xfe", 3));
  EXPECT_EQ(told.count(kPeerHeader), 1U) << "a client names itself";
  EXPECT_TRUE(told.find(kPeerHeader)->second.starts_with("ipv4:127.0.0.1:"));
}

TEST_F(DoorTest, OnlyATrustedProxySaysWhoCalls) {
  for (const bool trusts : {false, true}) {
    Open({.trusts_principal = trusts});
    grpc::ClientContext context;
    context.AddMetadata("x-contactd-principal", "user:ann");
    v1::Job job;
    EXPECT_TRUE(Stub()->GetJob(&context, {}, &job).ok());
    EXPECT_EQ(service_.metadata().count("x-contactd-principal"), trusts ? 1U : 0U);
    door_.reset();
  }
}

TEST_F(DoorTest, StreamsArriveWholeHoweverLargeTheirMessages) {
  Open();
  const auto stub = Stub();
  for (const auto& [size, count] : {std::pair{10, 20'000}, {1000, 2000}, {300'000, 20}}) {
    grpc::ClientContext context;
    v1::WatchJobRequest request;
    request.set_name(std::string(static_cast<std::size_t>(size), 'n'));
    request.set_after_sequence(static_cast<std::uint64_t>(count));
    const auto reader = stub->WatchJob(&context, request);
    int messages = 0;
    for (v1::WatchJobResponse response; reader->Read(&response); ++messages) {
      EXPECT_EQ(response.snapshot().name().size(), static_cast<std::size_t>(size));
    }
    EXPECT_EQ(messages, count);
    EXPECT_TRUE(reader->Finish().ok());
  }
}

TEST_F(DoorTest, AClientThatLeavesEndsItsStream) {
  Open();
  grpc::ClientContext context;
  const auto reader = Stub()->WatchJob(&context, {});
  ASSERT_TRUE(Eventually([&] { return service_.streaming == 1; }));
  context.TryCancel();
  EXPECT_TRUE(Eventually([&] { return service_.streaming == 0; }));
}

TEST_F(DoorTest, AClientThatTakesNothingIsCut) {
  Open({.stall = 100ms});
  grpc::ClientContext context;
  v1::WatchJobRequest request;
  request.set_name(std::string(100'000, 'n'));
  const auto reader = Stub()->WatchJob(&context, request);
  ASSERT_TRUE(Eventually([&] { return service_.streaming == 1; }));
  EXPECT_TRUE(Eventually([&] { return service_.streaming == 0; }));
  context.TryCancel();
}

TEST_F(DoorTest, DeadlinesAreTheServersToo) {
  Open();
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + 50ms);
  const auto reader = Stub()->WatchJob(&context, {});
  for (v1::WatchJobResponse response; reader->Read(&response);) {
  }
  EXPECT_EQ(reader->Finish().error_code(), grpc::DEADLINE_EXCEEDED);
  EXPECT_TRUE(Eventually([&] { return service_.streaming == 0; }));
}

TEST_F(DoorTest, ACallAfterTheDrainIsUnavailable) {
  Open();
  const auto stub = Stub();
  ASSERT_TRUE(Answers(*stub));
  door_->Drain();
  grpc::ClientContext context;
  v1::Job job;
  EXPECT_EQ(stub->GetJob(&context, {}, &job).error_code(), grpc::UNAVAILABLE);
}

TEST_F(DoorTest, ListensOnIpv6AndOnNames) {
  for (const std::string host : {"[::1]", "localhost"}) {
    Open({}, host + ":0");
    EXPECT_TRUE(Answers(*Stub(host + ":" + std::to_string(port_))));
    door_.reset();
  }
}

TEST_F(DoorTest, SocketFileIsForOwnerAndGroupAndTellsUsersApart) {
  const TempDirectory folder;
  const std::string file = folder.path() / "socket";
  Open({}, "unix:" + file);
  struct stat status = {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0660U);
  EXPECT_TRUE(Answers(*Stub("unix:" + file)));
  const std::string mine = "unix:" + std::to_string(getuid());
  const Names told = service_.metadata();
  EXPECT_EQ(PeerOf(told.find(kPeerHeader)->second), mine);
  door_.reset();
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(DoorTest, SilentConnectionIsClosed) {
  Open({.handshake = 50ms});
  EXPECT_TRUE(ClientSocket(port_).IsClosedByPeer());
}

TEST_F(DoorTest, ConnectionsPastTheLimitAreRefusedAndWhoLeavesMakesRoom) {
  Open({.connections = {.in_all = 3, .per_peer = 2}});
  ClientSocket first, second, other, last;
  first.Connect(port_);
  second.Connect(port_);
  EXPECT_TRUE(Eventually([&] { return door_->connections() == 2; }));
  EXPECT_TRUE(ClientSocket(port_).IsClosedByPeer()) << "one address cannot take all";
  other.Connect(port_, "127.0.0.2");
  EXPECT_TRUE(Eventually([&] { return door_->connections() == 3; }));
  last.Connect(port_, "127.0.0.3");
  EXPECT_TRUE(last.IsClosedByPeer());
  EXPECT_EQ(door_->refused_connections(), 2);
  first.Close();
  EXPECT_TRUE(Eventually([&] { return Answers(*Stub()); }));
}

TEST_F(DoorTest, AcceptsAgainAfterDescriptorsHadRunOut) {
  Open();
  std::vector<ClientSocket> clients(5);
  rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  rlimit none = before;
  none.rlim_cur = static_cast<rlim_t>(FileDescriptor(dup(STDERR_FILENO)).get());
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  for (ClientSocket& client : clients) client.Connect(port_);
  EXPECT_FALSE(clients.front().IsClosedByPeer(50ms)) << "it waits in the system's queue";
  EXPECT_EQ(door_->connections(), 0U);
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_TRUE(Eventually([&] { return door_->connections() == 5; }));
  EXPECT_EQ(door_->refused_connections(), 0);
}

}  // namespace
}  // namespace contact
