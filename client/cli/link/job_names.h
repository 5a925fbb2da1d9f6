#pragma once

#include <map>
#include <string>
#include <vector>

namespace contact::cli {

/// `jobs/ID` for `jobs/ID` or `ID`.
std::string JobName(const std::string& job);

/// `ID` for `jobs/ID`.
std::string ShortName(const std::string& name);

/// A request id that no other call has.
std::string RandomRequestId();

/// Reads KEY=VALUE texts. Throws Failure (kUsage).
std::map<std::string, std::string> ParseLabels(const std::vector<std::string>& texts);

}  // namespace contact::cli
