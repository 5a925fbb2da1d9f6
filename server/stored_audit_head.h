#pragma once

#include <filesystem>
#include <memory>

#include "identity/audit_log.h"
#include "storage/shared_store.h"

namespace contact {

/// Keeps the head of the audit log `file` of this machine in a store that processes share, where
/// whoever may write the log need not reach it. What is written while the store is busy with an
/// earlier digest is kept after it, only the newest. Its destructor waits for that. The store
/// outlives it.
std::unique_ptr<AuditHead> OpenStoredHead(SharedStore& store, const std::filesystem::path& file);

}  // namespace contact
