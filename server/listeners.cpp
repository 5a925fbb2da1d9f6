#include "listeners.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/clock.h"

namespace contact {
namespace {

bool HasFiles(const IdentityPaths& paths) {
  return AsksWhoCalls(paths) || !paths.tls.certificate.empty();
}

}  // namespace

Listeners::Listeners(JobManager& jobs, Store& store, const Config& config, v1::ServerInfo info)
    : jobs_(jobs), store_(store), config_(config), info_(std::move(info)) {}

std::string Listeners::Prepare() {
  if (!config_.audit_log.empty()) {
    const bool alone = config_.store_address.empty();
    auto opened = AuditLog::Open(config_.audit_log, config_.max_audit_bytes,
                                 alone ? config_.data_dir / "audit-head" : "");
    if (const auto* why = std::get_if<std::string>(&opened)) return "--audit-log: " + *why;
    audit_ = std::move(std::get<std::unique_ptr<AuditLog>>(opened));
  }
  if (!HasFiles(config_.identity)) return "";
  const auto take = [this](const TlsMaterial& material) {
    if (tls_) return tls_->Replace(material);
    tls_ = std::make_shared<TlsCredentials>(material);
  };
  const auto note = [audit = audit_](AuditRecord record) {
    if (audit) audit->Write(std::move(record));
  };
  auto opened = IdentityFiles::Open(config_.identity, take, note);
  if (const auto* why = std::get_if<std::string>(&opened)) return *why;
  files_ = std::get<std::shared_ptr<IdentityFiles>>(std::move(opened));
  return "";
}

Door Listeners::MainDoor() const {
  return AsksWhoCalls(config_.identity) ? Door(files_) : Door(LocalPrincipal());
}

std::string Listeners::Start() {
  if (!ListenHttp()) return config_.http_listen;
  GrpcServerOptions options = config_.rpc;
  options.metrics = calls_;
  options.audit = audit_;
  options.door = MainDoor();
  options.credentials = tls_ && !config_.listen.starts_with("unix:") ? tls_->Make() : nullptr;
  options.admin = config_.listen_admin.empty();
  const auto port = Open(config_.listen, options);
  if (!port) return config_.listen;
  port_ = *port;
  options.credentials = nullptr;
  options.reflection = options.channelz = options.admin = false;
  for (const SocketListener& socket : config_.listen_as) {
    options.door = Door(socket.principal);
    if (!Open("unix:" + socket.path, options)) return socket.path;
  }
  options.door = Door(TrustedProxy());
  if (!config_.trusted_proxy.empty() && !Open(config_.trusted_proxy, options)) {
    return config_.trusted_proxy;
  }
  if (config_.listen_admin.empty()) return "";
  options.door = Door(SocketAdmin());
  options.reflection = options.admin = true;
  options.channelz = config_.admin_channelz;
  return Open(config_.listen_admin, options) ? "" : config_.listen_admin;
}

std::optional<int> Listeners::Open(const std::string& address, const GrpcServerOptions& options) {
  servers_.push_back(std::make_unique<GrpcServer>(jobs_, store_, options, info_));
  return servers_.back()->Start(address);
}

bool Listeners::ListenHttp() {
  const std::string& address = config_.http_listen;
  if (address.empty()) return true;
  http_ = OpenListener(address);
  http_port_ = http_.port;
  info_.set_http_address(
      address.starts_with("unix:")
          ? address
          : fmt::format("http://{}:{}", address.substr(0, address.rfind(':')), http_port_));
  return !http_.sockets.empty();
}

void Listeners::ServeHttp(std::function<std::string()> metrics) {
  if (http_.sockets.empty()) return;
  GatewayOptions options{.rules = config_.http_rules,
                         .web_dir = config_.web_dir,
                         .max_body_bytes = static_cast<std::size_t>(config_.rpc.max_message_bytes),
                         .stall = config_.rpc.write_stall};
  options.connections.per_peer =
      std::min(options.connections.per_peer, config_.rpc.connections.per_peer);
  if (!MainDoor().asks() && config_.listen_admin.empty()) options.metrics = std::move(metrics);
  gateway_ =
      std::make_unique<Gateway>(std::move(http_), servers_.front()->Inside(), std::move(options));
}

SelfProbe Listeners::Probe() const {
  if (!config_.identity.tls.client_ca.empty()) return SelfProbe(servers_.front()->Inside());
  return {config_.listen, port_, tls_ && port_ != 0};
}

void Listeners::Shutdown(std::chrono::milliseconds grace) {
  using std::chrono::milliseconds;
  const auto end = SystemClock().Elapsed() + grace;
  for (const auto& server : servers_) server->Drain();
  if (gateway_) gateway_->Finish(grace);
  gateway_.reset();  // It calls the first server, and must not once that shuts down.
  for (const auto& server : servers_) {
    const auto left = std::chrono::duration_cast<milliseconds>(end - SystemClock().Elapsed());
    server->Shutdown(std::max(left, milliseconds(0)));
  }
}

void Listeners::AddTo(MetricsSources::Now* now) const {
  for (const auto& server : servers_) {
    now->watchers += server->watchers();
    now->connections += server->connections();
    now->refused_connections += server->refused_connections();
  }
  if (gateway_) {
    now->connections += gateway_->connections();
    now->refused_connections += gateway_->refused_connections();
  }
  if (!files_) return;
  now->tls_failures = files_->tls_failures();
  now->identity_failures = files_->failures();
  if (const auto end = files_->not_after()) {
    const std::chrono::duration<double> left = *end - SystemClock().Now();
    now->tls_seconds_left = left.count();
  }
}

std::shared_ptr<const StreamMetrics> Listeners::stream_metrics() const {
  return servers_.front()->stream_metrics();
}

}  // namespace contact
