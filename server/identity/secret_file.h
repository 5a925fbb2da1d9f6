#pragma once

#include <filesystem>
#include <string>

namespace contact {

/// Reads a file of at most 1 MiB. False, with the reason in `mistake`, if it cannot be read.
bool ReadTextFile(const std::filesystem::path& file, std::string* text, std::string* mistake);

/// As ReadTextFile, and refuses a file that any other than its owner may change: write it, or put
/// another in its place. Those who may are its group and others if they may write it or its folder;
/// in a folder such as /tmp, where nobody replaces what is not his (sticky), they may not.
bool ReadTrustedFile(const std::filesystem::path& file, std::string* text, std::string* mistake);

/// As ReadTrustedFile, and refuses a file that others than its owner and group may read.
bool ReadSecretFile(const std::filesystem::path& file, std::string* text, std::string* mistake);

}  // namespace contact
