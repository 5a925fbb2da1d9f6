#pragma once

#include <grpcpp/support/status.h>

#include <string>

namespace contact::gateway {

/// A gRPC code as the Connect protocol calls it, such as `not_found`.
const char* ConnectCode(grpc::StatusCode code);

/// The HTTP status of a unary Connect answer with this code.
int HttpStatus(grpc::StatusCode code);

/// An error in Connect's form: an object with `code`, `message` if there is one, and `details`, the
/// messages of the google.rpc.Status in the error's details; each with `type`, `value` in base64
/// and `debug` in JSON. Always valid UTF-8.
std::string ErrorJson(const grpc::Status& error);

}  // namespace contact::gateway
