#pragma once

#include <grpcpp/support/status.h>

#include "jobs/job/errors.h"

namespace contact {

/// The error as a gRPC status. Its details are a google.rpc.Status that always holds an ErrorInfo
/// of domain `contact`. It also holds a BadRequest if the error has violations, a ResourceInfo if
/// its code is NOT_FOUND, a QuotaFailure if its reason is QUOTA_EXCEEDED, and a RetryInfo if it has
/// a time after which to ask again.
///
/// Clients take at most 8 KiB of trailers. Violations that do not fit are left out; the metadata of
/// ErrorInfo then holds their number as `violations_left_out`.
grpc::Status ToGrpc(const Error& error);

}  // namespace contact
