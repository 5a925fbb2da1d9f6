#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <memory>
#include <string>
#include <utility>

#include "gateway/call/open_requests.h"
#include "gateway/call/options.h"
#include "gateway/net/memory.h"
#include "gateway/net/open_connections.h"
#include "gateway/protocol/rpc_request.h"
#include "gateway/protocol/static_files.h"

namespace contact::gateway {

/// What all connections of a listener share. Thread-safe; owned by shared pointers.
class Service {
 public:
  Service(const std::shared_ptr<grpc::Channel>& channel, GatewayOptions options)
      : options_(std::move(options)),
        stub_(channel),
        dashboard_(options_.web_dir, "the dashboard is not installed; see --web-dir"),
        docs_(options_.docs_dir, "the documentation is not installed; see --docs-dir"),
        connections_(std::make_shared<OpenConnections>(FitToDescriptors(options_.connections))) {}

  const GatewayOptions& options() const { return options_; }
  grpc::GenericStub& stub() { return stub_; }

  /// The answer to a request that is neither a call nor for `/readyz`, or why it is not answered.
  HttpAnswer Answer(const HttpRequest& request) const;
  /// Why a request is not answered; nothing if it is.
  std::optional<HttpAnswer> Refusal(const HttpRequest& request) const;

  /// The answer with what every answer has, but one of gRPC's own protocol: what a browser may do
  /// with it, and who may read it.
  HttpAnswer Complete(const HttpRequest& request, HttpAnswer answer) const;

  /// What the bodies of requests may take, and what whole answers may until they are sent.
  Memory& bodies() { return bodies_; }
  Memory& answers() { return answers_; }
  OpenRequests& requests() { return requests_; }
  const std::shared_ptr<OpenConnections>& connections() { return connections_; }

 private:
  /// The answer to a GET that is for a file.
  HttpAnswer File(const HttpRequest& request) const;

  const GatewayOptions options_;
  grpc::GenericStub stub_;
  const StaticFiles dashboard_;
  const StaticFiles docs_;
  Memory bodies_{options_.memory};
  Memory answers_{options_.memory};
  OpenRequests requests_;
  const std::shared_ptr<OpenConnections> connections_;
};

}  // namespace contact::gateway
