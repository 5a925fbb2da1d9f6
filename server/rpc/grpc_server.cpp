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
  builder->SetResourceQuota(grpc::ResourceQuota("contactd").SetMaxThreads(kMaxGrpcThreads));
  builder->SetMaxReceiveMessageSize(options.max_message_bytes);
}

// The services beside the contract's.
void ChoosePlugins(const GrpcServerOptions& options, grpc::ServerBuilder* builder) {
  builder->AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, options.channelz ? 1 : 0);
  if (!options.reflection) builder->SetOption(std::make_unique<Without>("proto_server_reflection"));
  if (!options.channelz) builder->SetOption(std::make_unique<Without>("channelz_service"));
}

// Counts all calls in `metrics`, and the open streams of each peer in `streams`.
void Monitor(std::shared_ptr<RpcMetrics> metrics, std::shared_ptr<PeerCounts> streams,
             grpc::ServerBuilder* builder) {
  std::vector<std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface>> monitors;
  monitors.push_back(std::make_unique<CallMonitor>(std::move(metrics), std::move(streams)));
  monitors.push_back(std::make_unique<MalformedRequests>());
  builder->experimental().SetInterceptorCreators(std::move(monitors));
}

v1::ServerInfo WithLimits(v1::ServerInfo identity, const GrpcServerOptions& options) {
  v1::ServerLimits& limits = *identity.mutable_limits();
  limits.set_max_message_bytes(options.max_message_bytes);
  limits.set_max_watchers_per_peer(options.calls.max_watchers_per_peer);
  limits.set_max_creates_per_second(options.calls.max_creates_per_second);
  limits.set_max_create_burst(options.calls.max_create_burst);
  limits.set_max_metadata_bytes(options.calls.max_metadata_bytes);
  return identity;
}

}  // namespace

GrpcServer::GrpcServer(JobManager& jobs, Store& store, const GrpcServerOptions& options,
                       v1::ServerInfo identity, const Clock& clock)
    : options_(options),
      loop_(std::make_shared<StreamLoop>(clock, options.write_stall)),
      metrics_(options_.metrics),
      guard_(options_.calls, options_.door, jobs.quotas(), streams_, metrics_, clock),
      calls_(guard_, loop_, options_.audit),
      jobs_(jobs, calls_, WithLimits(std::move(identity), options_)),
      models_(calls_),
      admin_(store, calls_) {}

GrpcServer::~GrpcServer() { Shutdown(1s); }

void GrpcServer::Start() {
  // gRPC answers health checks without a descriptor; this one lets reflection describe them.
  google::protobuf::LinkMessageReflection<grpc::health::v1::HealthCheckRequest>();
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  if (options_.channelz) grpc::channelz::experimental::InitChannelzService();
  grpc::ServerBuilder builder;
  builder.RegisterService(&jobs_);
  builder.RegisterService(&models_);
  if (options_.admin) builder.RegisterService(&admin_);
  LimitMemory(options_, &builder);
  ChoosePlugins(options_, &builder);
  Monitor(metrics_, streams_, &builder);
  server_ = builder.BuildAndStart();
  server_->GetHealthCheckService()->SetServingStatus("contact.v1.JobService", true);
}

std::shared_ptr<grpc::Channel> GrpcServer::Inside() const {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);  // Its answers are the server's own.
  arguments.SetInt(GRPC_ARG_ENABLE_RETRIES, 0);
  return server_->InProcessChannel(arguments);
}

void GrpcServer::Drain() {
  if (server_) server_->GetHealthCheckService()->SetServingStatus(false);
  loop_->Drain();
}

void GrpcServer::Shutdown(milliseconds grace) {
  Drain();
  if (server_) {
    const auto give_up = [] {
      spdlog::critical("gRPC did not shut down in time; ending the process");
      std::_Exit(1);
    };
    const ShutdownTimer timer(grace + 3s, give_up);
    server_->Shutdown(std::chrono::system_clock::now() + grace);
    server_.reset();
  }
  if (options_.audit) options_.audit->Flush();  // What it has yet to begin uses the services.
  loop_->Stop();
}

}  // namespace contact
