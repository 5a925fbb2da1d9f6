#pragma once

#include <grpcpp/support/status.h>

#include "jobs/job/error.h"

namespace contact {

/// The error as a gRPC status. Its details are a google.rpc.Status that always holds ErrorInfo
/// (domain `contact`), and BadRequest, RetryInfo or ResourceInfo where the error has such a side.
///
/// Clients take at most 8 KiB of trailers. Violations that do not fit are left out; their number
/// is then `violations_left_out` in the metadata of ErrorInfo.
grpc::Status ToGrpc(const Error& error);

}  // namespace contact
