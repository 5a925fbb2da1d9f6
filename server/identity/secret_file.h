#pragma once

#include <filesystem>
#include <string>

namespace contact {

/// Reads a file of at most 1 MiB. False, with the reason in `mistake`, if it cannot be read.
bool ReadTextFile(const std::filesystem::path& file, std::string* text, std::string* mistake);

/// As ReadTextFile, and refuses a file that others than its owner and group may read, or that any
/// other than its owner may write.
bool ReadSecretFile(const std::filesystem::path& file, std::string* text, std::string* mistake);

}  // namespace contact
