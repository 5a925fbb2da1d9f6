#pragma once

#include <google/protobuf/message.h>
#include <grpcpp/support/client_interceptor.h>

#include <memory>
#include <vector>

namespace contact::cli {

/// Replaces what steers a terminal, see PrintableLines, in all texts of the message and of those in
/// it; bytes stay as they are.
void MakePrintable(google::protobuf::Message* message);

using Interceptors =
    std::vector<std::unique_ptr<grpc::experimental::ClientInterceptorFactoryInterface>>;

/// Has every answer and every error of a channel pass MakePrintable, before anybody reads it: a
/// server, or what passes for one, must not write to the user's terminal.
Interceptors PrintableAnswers();

}  // namespace contact::cli
