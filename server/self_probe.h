#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <memory>
#include <string>

namespace contact {

/// Asks this server for its health as a client does, so that its supervisor hears of a server that
/// runs and no longer answers. Keeps one connection, which limits of connections do not end.
class SelfProbe {
 public:
  /// Asks at `listen`, HOST:PORT or unix:PATH; `port` is that of the listener. With `tls` it does
  /// not look at the certificate: it knows whom it asks.
  SelfProbe(const std::string& listen, int port, bool tls);
  /// Asks over this channel.
  explicit SelfProbe(std::shared_ptr<grpc::Channel> channel) : channel_(std::move(channel)) {}

  /// True if the server says within `patience` that it serves.
  bool Answers(std::chrono::microseconds patience) const;

 private:
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace contact
