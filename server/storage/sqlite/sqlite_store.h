#pragma once

#include <absl/status/statusor.h>

#include <filesystem>
#include <memory>

#include "storage/store.h"

namespace contact {

/// Opens or makes the store in a directory, and locks it for this process.
/// UNAVAILABLE: another process holds it. DATA_LOSS: the database is damaged, or gone though it
/// was there. FAILED_PRECONDITION: it is newer than this program, or cannot be written.
absl::StatusOr<std::unique_ptr<Store>> OpenSqlite(const std::filesystem::path& directory,
                                                  StoreOptions options = {});

}  // namespace contact
