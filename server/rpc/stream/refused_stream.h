#pragma once

#include <grpcpp/grpcpp.h>

#include "rpc/call/status.h"

namespace contact {

/// A streaming call that ends at once, with an error. Owns itself until gRPC is done with it.
template <class Response>
class RefusedStream final : public grpc::ServerWriteReactor<Response> {
 public:
  explicit RefusedStream(const Error& error) { this->Finish(ToGrpc(error)); }

 private:
  void OnDone() override { delete this; }
};

}  // namespace contact
