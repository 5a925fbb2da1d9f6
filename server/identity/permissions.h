#pragma once

#include <span>
#include <string_view>

#include "identity/principal.h"

namespace contact {

/// What the server demands of the callers of a method.
struct MethodRule {
  /// As gRPC calls it, such as `/contact.v1.JobService/GetJob`.
  std::string_view method;
  /// What the caller needs.
  Permission needs;
  /// True if the call changes something; the audit log then has it, also if it succeeds.
  bool mutation;
};

/// The table of all methods of the contract.
std::span<const MethodRule> MethodRules();

/// The row of the method; null for a method that the table does not have: nobody may call it.
const MethodRule* FindMethod(std::string_view method);

}  // namespace contact
