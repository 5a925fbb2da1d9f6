#pragma once

#include <grpcpp/support/server_interceptor.h>

namespace contact {

/// Has calls whose request is no message of its type fail with INVALID_ARGUMENT (FIELD_INVALID).
/// gRPC 1.51 ends them itself, as if there were no such method: with UNIMPLEMENTED and no words.
class MalformedRequests final : public grpc::experimental::ServerInterceptorFactoryInterface {
 public:
  /// The interceptor of one call. gRPC owns and deletes it.
  grpc::experimental::Interceptor* CreateServerInterceptor(
      grpc::experimental::ServerRpcInfo* info) override;
};

}  // namespace contact
