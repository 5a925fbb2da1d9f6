#include "rpc/grpc_server.h"

#include <google/protobuf/message.h>
#include <grpc/grpc.h>
#include <grpcpp/ext/channelz_service_plugin.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/impl/server_builder_option.h>
#include <grpcpp/resource_quota.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <utility>
#include <vector>

#include "grpc/health/v1/health.pb.h"
#include "rpc/call/malformed_request.h"
#include "rpc/metrics/call_monitor.h"
#include "rpc/net/listener.h"
#include "rpc/shutdown_timer.h"

namespace contact {
namespace {

using std::chrono::milliseconds;
using namespace std::chrono_literals;

// Plugins register with every server of the process; this takes one out again.
class Without final : public grpc::ServerBuilderOption {
 public:
  explicit Without(std::string plugin) : plugin_(std::move(plugin)) {}
  void UpdateArguments(grpc::ChannelArguments* /*arguments*/) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>* plugins) override {
    std::erase_if(*plugins, [this](const auto& plugin) { return plugin->name() == plugin_; });
  }

 private:
  const std::string plugin_;
};

void LimitMemory(const GrpcServerOptions& options, grpc::ServerBuilder* builder) {
  constexpr int kMaxGrpcThreads = 32;
  builder->SetResourceQuota(grpc::ResourceQuota("contactd")
                                .Resize(static_cast<std::size_t>(options.max_memory_bytes))
                                .SetMaxThreads(kMaxGrpcThreads));
  builder->SetMaxReceiveMessageSize(options.max_message_bytes);
  builder->AddChannelArgument(GRPC_ARG_MAX_METADATA_SIZE, options.calls.max_metadata_bytes);
  builder->AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, 1000);
  // A few compressed bytes must not become hundreds of megabytes.
  builder->SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_DEFLATE, false);
  builder->SetCompressionAlgorithmSupportStatus(GRPC_COMPRESS_GZIP, false);
}

// When connections are probed and closed. There is no largest age: it would cut every long watch,
// and there is no load balancer that needs it.
void TimeConnections(const GrpcServerOptions& options, grpc::ServerBuilder* builder) {
  builder->AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS,
                              static_cast<int>(options.handshake_timeout.count()));
  // Idle watches are probed. A busy client with gRPC's synchronous interface answers a ping only
  // every 5 s, so a timeout of 10 s would be too close, and 20 s is not.
  builder->AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 30'000);
  builder->AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 20'000);
  builder->AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder->AddChannelArgument(GRPC_ARG_HTTP2_MAX_PINGS_WITHOUT_DATA, 0);
  builder->AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 10'000);
  builder->AddChannelArgument(GRPC_ARG_HTTP2_MAX_PING_STRIKES, 2);
  builder->AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, 300'000);
}

// The services beside the contract's.
void ChoosePlugins(const GrpcServerOptions& options, grpc::ServerBuilder* builder) {
  builder->AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, options.channelz ? 1 : 0);
  if (!options.reflection) builder->SetOption(std::make_unique<Without>("proto_server_reflection"));
  if (!options.channelz) builder->SetOption(std::make_unique<Without>("channelz_service"));
}

// Counts all calls in `metrics`, and the open streams of each peer in `streams`; tells `floods`.
void Monitor(std::shared_ptr<RpcMetrics> metrics, std::shared_ptr<PeerCounts> streams,
             std::shared_ptr<FloodGuard> floods, grpc::ServerBuilder* builder) {
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> monitors;
  monitors.push_back(
      std::make_unique<CallMonitor>(std::move(metrics), std::move(streams), std::move(floods)));
  monitors.push_back(std::make_unique<MalformedRequests>());
  builder->experimental().SetInterceptorCreators(std::move(monitors));
}

GrpcServerOptions Fitted(GrpcServerOptions options) {
  options.connections = FitToDescriptors(options.connections);
  options.connections.stall = options.write_stall;
  return options;
}

v1::ServerInfo WithLimits(v1::ServerInfo identity, const GrpcServerOptions& options) {
  v1::ServerLimits& limits = *identity.mutable_limits();
  limits.set_max_message_bytes(options.max_message_bytes);
  limits.set_max_watchers_per_peer(options.calls.max_watchers_per_peer);
  limits.set_max_creates_per_second(options.calls.max_creates_per_second);
  limits.set_max_create_burst(options.calls.max_create_burst);
  limits.set_max_metadata_bytes(options.calls.max_metadata_bytes);
  limits.set_max_connections(options.connections.in_all);
  limits.set_max_connections_per_peer(options.connections.per_peer);
  return identity;
}

}  // namespace

GrpcServer::GrpcServer(JobManager& jobs, Store& store, const GrpcServerOptions& options,
                       v1::ServerInfo identity, const Clock& clock)
    : options_(Fitted(options)),
      loop_(std::make_shared<StreamLoop>(clock, options.write_stall)),
      metrics_(options_.metrics),
      guard_(options_.calls, options_.door, jobs.quotas(), streams_, metrics_, clock),
      calls_(guard_, loop_, options_.audit),
      jobs_(jobs, calls_, WithLimits(std::move(identity), options_)),
      admin_(store, calls_) {}

GrpcServer::~GrpcServer() { Shutdown(1s); }

std::optional<int> GrpcServer::Start(const std::string& address) {
  // Never taken back: the last grpc_shutdown waits 10 s for connections of clients that read
  // nothing.
  grpc_init();
  // gRPC answers health checks without a descriptor; this one lets reflection describe them.
  google::protobuf::LinkMessageReflection<grpc::health::v1::HealthCheckRequest>();
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  if (options_.channelz) grpc::channelz::experimental::InitChannelzService();
  grpc::ServerBuilder builder;
  builder.RegisterService(&jobs_);
  if (options_.admin) builder.RegisterService(&admin_);
  LimitMemory(options_, &builder);
  TimeConnections(options_, &builder);
  ChoosePlugins(options_, &builder);
  Monitor(metrics_, streams_, floods_, &builder);
  const auto port = Listen(OpenListener(address), builder);
  if (!port) return std::nullopt;
  server_->GetHealthCheckService()->SetServingStatus("contact.v1.JobService", true);
  return port;
}

std::optional<int> GrpcServer::Listen(Listener listener, grpc::ServerBuilder& builder) {
  if (listener.sockets.empty()) return std::nullopt;
  const int port = listener.port;
  using Experimental = grpc::ServerBuilder::experimental_type;
  const std::shared_ptr<grpc::experimental::ExternalConnectionAcceptor> grpc =
      builder.experimental().AddExternalConnectionAcceptor(
          Experimental::ExternalConnectionType::FROM_FD,
          options_.credentials ? options_.credentials : grpc::InsecureServerCredentials());
  server_ = builder.BuildAndStart();
  if (!server_) return std::nullopt;
  acceptor_ = std::make_unique<ConnectionAcceptor>(
      std::move(listener), options_.connections,
      [this, grpc](int socket, int fd) {
        hand_over_.Post([grpc, socket, fd] {
          grpc::experimental::ExternalConnectionAcceptor::NewConnectionParameters connection;
          connection.listener_fd = socket;
          connection.fd = fd;
          grpc->HandleNewConnection(&connection);
        });
      },
      [this](const std::vector<Traffic>& all, std::chrono::steady_clock::time_point now) {
        floods_->Look(all, now);
      });
  floods_->SetCut([this](const std::string& uri) { acceptor_->Cut(uri); });
  return port;
}

void GrpcServer::Drain() {
  if (server_) server_->GetHealthCheckService()->SetServingStatus(false);
  loop_->Drain();
}

void GrpcServer::Shutdown(milliseconds grace) {
  Drain();
  if (acceptor_) acceptor_->Close();
  if (server_) {
    const auto cut = [this] {
      if (acceptor_) acceptor_->Cut();
    };
    const auto give_up = [] {
      spdlog::critical("gRPC did not shut down in time; ending the process");
      std::_Exit(1);
    };
    {
      const ShutdownTimer timer(grace + 500ms, cut, grace + 2s, give_up);
      server_->Shutdown(std::chrono::system_clock::now() + grace);
      hand_over_.Stop();
      server_.reset();
    }  // The timer may be cutting connections of the acceptor until here.
    floods_->SetCut(nullptr);
    acceptor_.reset();
  }
  if (options_.audit) options_.audit->Flush();  // What it has yet to begin uses the services.
  loop_->Stop();
}

}  // namespace contact
