#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "identity/audit_log.h"
#include "identity/token_table.h"

namespace contact {

/// What the audit log says of a file of tokens that was read: a line for each token that is valid
/// at the start of the server (code VALID; `before` is null), and later for each that was made,
/// revoked, removed or changed in another way (CREATED, REVOKED, REMOVED, CHANGED). The principal
/// is that of the token; who has changed the file is not known.
std::vector<AuditRecord> TokenChanges(const TokenTable* before, const TokenTable& now,
                                      const std::string& file,
                                      std::chrono::system_clock::time_point time);

}  // namespace contact
