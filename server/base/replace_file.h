#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string_view>
#include <system_error>

namespace contact {

/// Writes `contents` to `file` so that other processes, and whoever reads after a crash or power
/// failure, see either the old contents or all of the new.
///
/// Writes a draft, the file's name with `.new` appended, and passes it to MoveIntoPlace. `mode` is
/// the permission bits of the new file before the process's umask. Returns the error of the system
/// call that failed, with the draft removed and `file` as it was.
std::error_code ReplaceFile(const std::filesystem::path& file, std::string_view contents,
                            mode_t mode = 0666);

/// Renames `draft`, a closed and complete file, to `file` in the same folder, replacing what is
/// there. On success the contents and the new name are on disk: the draft is synchronised before
/// the rename and the folder after it. Returns the error of the system call that failed; the draft
/// is left for the caller, unless only the folder could not be synchronised.
std::error_code MoveIntoPlace(const std::filesystem::path& draft,
                              const std::filesystem::path& file);

}  // namespace contact
