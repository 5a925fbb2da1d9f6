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
    : jobs_(jobs),
      store_(store),
      config_(config),
      info_(std::move(info)),
      threads_(static_cast<std::size_t>(config.max_connection_bytes)) {
  const ConnectionLimits fitted = FitToDescriptors(config.connections);
  info_.mutable_limits()->set_max_connections(fitted.in_all);
  info_.mutable_limits()->set_max_connections_per_peer(fitted.per_peer);
}

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
    tls_ = std::make_shared<gateway::TlsContext>(material);
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

GatewayOptions Listeners::OptionsOf(const std::string& address) const {
  return {.rules = config_.http_rules,
          .tls = address.starts_with("unix:") ? nullptr : tls_,
          .web_dir = config_.web_dir,
          .docs_dir = config_.docs_dir,
          .max_body_bytes = static_cast<std::size_t>(config_.rpc.max_message_bytes),
          .connections = config_.connections,
          .stall = config_.rpc.write_stall};
}

const GrpcServer& Listeners::Add(const GrpcServerOptions& options) {
  servers_.push_back(std::make_unique<GrpcServer>(jobs_, store_, options, info_));
  servers_.back()->Start();
  return *servers_.back();
}

std::string Listeners::StartMain() {
  constexpr std::size_t kHttp = 1;  // Of --http-listen, which has no TLS.
  std::vector<std::string> addresses = {config_.listen, config_.http_listen};
  addresses.insert(addresses.end(), config_.more_listen.begin(), config_.more_listen.end());
  std::vector<Listener> listeners;
  for (const std::string& address : addresses) {
    listeners.push_back(address.empty() ? Listener() : OpenListener(address));
    if (!address.empty() && listeners.back().sockets.empty()) return address;
  }
  port_ = listeners[0].port;
  http_port_ = listeners[kHttp].port;
  info_.set_http_address(HttpAddress());
  GrpcServerOptions options = config_.rpc;
  options.metrics = calls_;
  options.audit = audit_;
  options.door = MainDoor();
  options.admin = config_.listen_admin.empty();
  const GrpcServer& server = Add(options);
  for (std::size_t i = 0; i < listeners.size(); ++i) {
    if (listeners[i].sockets.empty()) continue;
    opened_.push_back({std::move(listeners[i]), &server, OptionsOf(addresses[i])});
    if (i == kHttp) opened_.back().options.tls = nullptr;
  }
  return "";
}

bool Listeners::StartFile(const std::string& address, const GrpcServerOptions& options,
                          bool trusts_principal) {
  Listener listener = OpenListener(address);
  if (listener.sockets.empty()) return false;
  GatewayOptions how = OptionsOf(address);
  how.trusts_principal = trusts_principal;
  opened_.push_back({std::move(listener), &Add(options), std::move(how)});
  return true;
}

std::string Listeners::Start() {
  if (std::string taken = StartMain(); !taken.empty()) return taken;
  GrpcServerOptions options = config_.rpc;
  options.metrics = calls_;
  options.audit = audit_;
  options.reflection = options.channelz = options.admin = false;
  for (const SocketListener& socket : config_.listen_as) {
    options.door = Door(socket.principal);
    if (!StartFile("unix:" + socket.path, options)) return socket.path;
  }
  options.door = Door(TrustedProxy());
  if (!config_.trusted_proxy.empty() && !StartFile(config_.trusted_proxy, options, true)) {
    return config_.trusted_proxy;
  }
  if (config_.listen_admin.empty()) return "";
  options.door = Door(SocketAdmin());
  options.reflection = options.admin = true;
  options.channelz = config_.admin_channelz;
  return StartFile(config_.listen_admin, options) ? "" : config_.listen_admin;
}

void Listeners::Serve(const std::function<std::string()>& metrics) {
  const bool tells = !MainDoor().asks() && config_.listen_admin.empty();
  for (Opened& opened : std::exchange(opened_, {})) {
    const bool main = opened.server == servers_.front().get();
    if (tells && main) opened.options.metrics = metrics;
    gateways_.push_back(std::make_unique<Gateway>(
        threads_, std::move(opened.listener), opened.server->Inside(), std::move(opened.options)));
  }
}

std::string Listeners::HttpAddress() const {
  const bool own = !config_.http_listen.empty();
  const std::string& address = own ? config_.http_listen : config_.listen;
  if (address.starts_with("unix:")) return address;
  const char* scheme = own || !tls_ ? "http" : "https";
  return fmt::format("{}://{}:{}", scheme, address.substr(0, address.rfind(':')),
                     own ? http_port_ : port_);
}

SelfProbe Listeners::Probe() const {
  if (!config_.identity.tls.client_ca.empty()) return SelfProbe(servers_.front()->Inside());
  return {config_.listen, port_, tls_ && port_ != 0};
}

void Listeners::Shutdown(std::chrono::milliseconds grace) {
  using std::chrono::milliseconds;
  const auto end = SystemClock().Elapsed() + grace;
  const auto left = [&] {
    const auto time = std::chrono::duration_cast<milliseconds>(end - SystemClock().Elapsed());
    return std::max(time, milliseconds(0));
  };
  for (const auto& gateway : gateways_) gateway->Drain();
  for (const auto& server : servers_) server->Drain();
  for (const auto& gateway : gateways_) gateway->Finish(left());
  gateways_.clear();  // They call the servers, and must not once those shut down.
  for (const auto& server : servers_) server->Shutdown(left());
}

void Listeners::AddTo(MetricsSources::Now* now) const {
  for (const auto& server : servers_) {
    now->watchers += server->watchers();
  }
  for (const auto& gateway : gateways_) {
    now->connections += gateway->connections();
    now->refused_connections += gateway->refused_connections();
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
