#include "rpc/grpc_server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/impl/server_builder_option.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace contact {
namespace {

using std::chrono::milliseconds;
using namespace std::chrono_literals;

// Linking the reflection library registers it with every server; this takes it out again.
class NoReflection final : public grpc::ServerBuilderOption {
 public:
  void UpdateArguments(grpc::ChannelArguments* /*arguments*/) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>* plugins) override {
    std::erase_if(*plugins,
                  [](const auto& plugin) { return plugin->name() == "proto_server_reflection"; });
  }
};

void Configure(const GrpcServerOptions& options, grpc::ServerBuilder* builder) {
  builder->SetMaxReceiveMessageSize(options.max_message_bytes);
  // A few compressed bytes must not become hundreds of megabytes.
  builder->SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder->SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
  // Two servers on one port would share its connections without a word.
  builder->AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  builder->AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 1000);
  builder->AddChannelArgument(GRPC_ARG_MAX_METADATA_SIZE, 8192);
  builder->AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, 5'000);
  // Idle watches are probed; a client that is busy may take seconds to answer a ping.
  builder->AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  builder->AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20'000);
  builder->AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder->AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder->AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 10'000);
  builder->AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, 300'000);
  if (!options.reflection) builder->SetOption(std::make_unique<NoReflection>());
}

// Ends the process unless it is destroyed in time.
class Watchdog {
 public:
  explicit Watchdog(milliseconds limit) : thread_([this, limit] { Watch(limit); }) {}
  ~Watchdog() {
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
      changed_.notify_one();
    }
    thread_.join();
  }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  void Watch(milliseconds limit) {
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, limit, [this] { return done_; })) return;
    spdlog::critical("gRPC did not shut down in {} ms; ending the process", limit.count());
    std::_Exit(1);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool done_ = false;
  std::thread thread_;
};

v1::ServerInfo WithMessageLimit(v1::ServerInfo identity, const GrpcServerOptions& options) {
  identity.mutable_limits()->set_max_message_bytes(options.max_message_bytes);
  return identity;
}

}  // namespace

GrpcServer::GrpcServer(JobManager& jobs, GrpcServerOptions options, v1::ServerInfo identity)
    : options_(options),
      watches_(std::make_shared<WatchLoop>(std::clamp(options.write_stall / 4, 10ms, 500ms))),
      service_(jobs, watches_, WithMessageLimit(std::move(identity), options), options.write_stall),
      admin_(jobs, options.write_stall) {}

GrpcServer::~GrpcServer() { Shutdown(1s); }

std::optional<int> GrpcServer::Start(const std::string& address) {
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort(address, grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&service_);
  builder.RegisterService(&admin_);
  Configure(options_, &builder);
  server_ = builder.BuildAndStart();
  if (!server_ || port == 0) return std::nullopt;
  server_->GetHealthCheckService()->SetServingStatus("contact.v1.JobService", true);
  return port;
}

void GrpcServer::Drain() {
  if (server_) server_->GetHealthCheckService()->SetServingStatus(false);
  watches_->Drain();
}

void GrpcServer::Shutdown(milliseconds grace) {
  Drain();
  if (server_) {
    const Watchdog watchdog(grace + 2s);
    server_->Shutdown(std::chrono::system_clock::now() + grace);
    server_.reset();
  }
  watches_->Stop();
}

}  // namespace contact
