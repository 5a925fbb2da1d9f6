#include "self_probe.h"

#include <fmt/format.h>
#include <grpcpp/security/tls_certificate_verifier.h>
#include <grpcpp/security/tls_credentials_options.h>

#include "address.h"
#include "grpc/health/v1/health.grpc.pb.h"

namespace contact {
namespace {

namespace health = grpc::health::v1;

// Where a client on this machine reaches the listener.
std::string Reachable(const std::string& listen, int port) {
  const auto host = HostOf(listen);
  if (!host) return listen;
  if (*host == "0.0.0.0") return fmt::format("127.0.0.1:{}", port);
  return fmt::format("{}:{}", *host == "[::]" ? "[::1]" : *host, port);
}

std::shared_ptr<grpc::ChannelCredentials> Encrypted() {
  using namespace grpc::experimental;
  TlsChannelCredentialsOptions options;
  options.set_verify_server_certs(false);
  options.set_check_call_host(false);
  options.set_certificate_verifier(std::make_shared<NoOpCertificateVerifier>());
  return TlsCredentials(options);
}

}  // namespace

SelfProbe::SelfProbe(const std::string& listen, int port, bool tls)
    : channel_(grpc::CreateChannel(Reachable(listen, port),
                                   tls ? Encrypted() : grpc::InsecureChannelCredentials())) {}

bool SelfProbe::Answers(std::chrono::microseconds patience) const {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + patience);
  context.set_wait_for_ready(true);
  health::HealthCheckResponse response;
  const grpc::Status status = health::Health::NewStub(channel_)->Check(&context, {}, &response);
  return status.ok() && response.status() == health::HealthCheckResponse::SERVING;
}

}  // namespace contact
