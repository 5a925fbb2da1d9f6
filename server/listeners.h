#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "config.h"
#include "gateway/gateway.h"
#include "identity/identity_files.h"
#include "rpc/metrics/metrics_page.h"
#include "rpc/net/tls_credentials.h"
#include "self_probe.h"

namespace contact {

/// All listeners of the server, each with the identity that it asks for: `--listen`, every
/// `--listen-as`, and `--listen-admin`.
class Listeners {
 public:
  /// Manager and store outlive it. `info`: see JobService.
  Listeners(JobManager& jobs, Store& store, const Config& config, v1::ServerInfo info);

  /// Reads the files of identity and opens the audit log. Returns what is wrong; empty: nothing.
  std::string Prepare();

  /// Opens all listeners. Returns the address that cannot be had; empty: none.
  std::string Start();

  /// Serves `--http-listen`, if it is given; after Start. `metrics`: the text of the metrics page,
  /// which is served where nobody is asked who calls and AdminService has no listener of its own.
  void ServeHttp(std::function<std::string()> metrics);
  /// The port of `--http-listen`; 0 for a socket file, and for none.
  int http_port() const { return http_port_; }

  /// The port of `--listen`; 0 for a socket file.
  int port() const { return port_; }

  /// Asks the server at `--listen`; past the listener if that wants client certificates.
  SelfProbe Probe() const;

  /// Ends the gateway, which calls the first server, then the servers, as GrpcServer::Shutdown; all
  /// calls together get `grace`.
  void Shutdown(std::chrono::milliseconds grace);

  /// Adds what is known of connections, streams, certificate and files of identity.
  void AddTo(MetricsSources::Now* now) const;
  /// Counters of the calls of all listeners, and of the streams of `--listen`.
  std::shared_ptr<const RpcMetrics> metrics() const { return calls_; }
  std::shared_ptr<const StreamMetrics> stream_metrics() const;

 private:
  /// Who comes in by `--listen`.
  Door MainDoor() const;
  /// Listens on `--http-listen`, if it is given, and tells clients. False: it cannot be had.
  bool ListenHttp();
  /// Opens a listener; its port, or nothing if the address cannot be had.
  std::optional<int> Open(const std::string& address, const GrpcServerOptions& options);

  JobManager& jobs_;
  Store& store_;
  const Config& config_;
  v1::ServerInfo info_;
  const std::shared_ptr<RpcMetrics> calls_ = std::make_shared<RpcMetrics>();
  std::shared_ptr<AuditLog> audit_;
  /// Null without TLS.
  std::shared_ptr<TlsCredentials> tls_;
  /// Null without files of identity.
  std::shared_ptr<IdentityFiles> files_;
  int port_ = 0;
  /// That of `--listen` first.
  std::vector<std::unique_ptr<GrpcServer>> servers_;
  /// Of `--http-listen`, until it is served.
  Listener http_;
  int http_port_ = 0;
  /// Null without `--http-listen`. Calls the first server.
  std::unique_ptr<Gateway> gateway_;
};

}  // namespace contact
