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
#include "self_probe.h"

namespace contact {

/// All listeners of the server, each with the identity that it asks for: `--listen`, every
/// `--listen-as`, and `--listen-admin`. Each kind of identity has a gRPC server of its own, and
/// each listener a gateway before it.
class Listeners {
 public:
  /// Manager and store outlive it. `info`: see JobService.
  Listeners(JobManager& jobs, Store& store, const Config& config, v1::ServerInfo info);

  /// Reads the files of identity and opens the audit log. Returns what is wrong; empty: nothing.
  std::string Prepare();

  /// Opens all listeners and starts the servers; who connects waits for Serve. Returns the address
  /// that cannot be had; empty: none.
  std::string Start();
  /// Serves those who connect. `metrics`: the text of the metrics page, which is there where nobody
  /// is asked who calls and AdminService has no listener of its own.
  void Serve(const std::function<std::string()>& metrics);
  /// The port of `--http-listen`; 0 for a socket file, and for none.
  int http_port() const { return http_port_; }

  /// The port of `--listen`; 0 for a socket file.
  int port() const { return port_; }

  /// Asks the server at `--listen`; past the listener if that wants client certificates.
  SelfProbe Probe() const;

  /// Ends the gateways, then the servers that they call, as GrpcServer::Shutdown; all calls
  /// together get `grace`.
  void Shutdown(std::chrono::milliseconds grace);

  /// Adds what is known of connections, streams, certificate and files of identity.
  void AddTo(MetricsSources::Now* now) const;
  /// Counters of the calls of all listeners, and of the streams of `--listen`.
  std::shared_ptr<const RpcMetrics> metrics() const { return calls_; }
  std::shared_ptr<const StreamMetrics> stream_metrics() const;

 private:
  /// Who comes in by `--listen`.
  Door MainDoor() const;
  /// What the gateway of a listener is to do, without its metrics.
  GatewayOptions OptionsOf(const std::string& address) const;
  /// A listener that waits for Serve, with the server that answers there.
  struct Opened {
    Listener listener;
    const GrpcServer* server;
    GatewayOptions options;
  };
  /// Listens on `--listen` and `--http-listen`, where the first server answers. Returns the address
  /// that cannot be had.
  std::string StartMain();
  /// Where browsers find the server.
  std::string HttpAddress() const;
  /// A server with these options, which serves.
  const GrpcServer& Add(const GrpcServerOptions& options);
  /// Serves a socket file by a server of its own. False: it cannot be had.
  bool StartFile(const std::string& address, const GrpcServerOptions& options,
                 bool trusts_principal = false);

  JobManager& jobs_;
  Store& store_;
  const Config& config_;
  v1::ServerInfo info_;
  const std::shared_ptr<RpcMetrics> calls_ = std::make_shared<RpcMetrics>();
  std::shared_ptr<AuditLog> audit_;
  /// Null without TLS.
  std::shared_ptr<gateway::TlsContext> tls_;
  /// Null without files of identity.
  std::shared_ptr<IdentityFiles> files_;
  int port_ = 0;
  /// That of `--listen` first.
  std::vector<std::unique_ptr<GrpcServer>> servers_;
  int http_port_ = 0;
  std::vector<Opened> opened_;
  GatewayThreads threads_;
  /// Each calls a server.
  std::vector<std::unique_ptr<Gateway>> gateways_;
};

}  // namespace contact
