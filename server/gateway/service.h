#pragma once

#include <grpcpp/generic/generic_stub.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

#include "gateway/options.h"
#include "gateway/protocol/static_files.h"

namespace contact::gateway {

/// What all connections of the gateway share. Thread-safe.
class Service {
 public:
  Service(const std::shared_ptr<grpc::Channel>& channel, GatewayOptions options)
      : options_(std::move(options)), stub_(channel), files_(options_.web_dir) {}

  const GatewayOptions& options() const { return options_; }
  grpc::GenericStub& stub() { return stub_; }

  /// The answer to a request that is neither a call nor for `/readyz`, or why it is not answered.
  HttpAnswer Answer(const HttpRequest& request) const;
  /// Why a request is not answered; nothing if it is.
  std::optional<HttpAnswer> Refusal(const HttpRequest& request) const {
    return Refuse(options_.rules, request);
  }

  /// The answer with what every answer has: what a browser may do with it, and who may read it.
  HttpAnswer Complete(const HttpRequest& request, HttpAnswer answer) const;

  /// Reserves memory for the body of a request; false if there is none. Small bodies need none.
  bool Reserve(std::size_t bytes);
  void GiveBack(std::size_t bytes) { reserved_ -= bytes; }

 private:
  const GatewayOptions options_;
  grpc::GenericStub stub_;
  const StaticFiles files_;
  /// Bytes of the bodies that are being read.
  std::atomic<std::size_t> reserved_ = 0;
};

}  // namespace contact::gateway
