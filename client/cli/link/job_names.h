#pragma once

#include <map>
#include <string>
#include <vector>

namespace contact::cli {

/// `jobs/ID` for `jobs/ID` or `ID`.
std::string JobName(const std::string& job);

/// `ID` for `jobs/ID`.
std::string ShortName(const std::string& name);

/// A random UUID, to be the request_id of one CreateJob call and its retries.
std::string RandomRequestId();

/// Reads KEY=VALUE texts of --label; the last value of a key counts. Throws Failure (kUsage) for a
/// text of another form.
std::map<std::string, std::string> ParseLabels(const std::vector<std::string>& texts);

}  // namespace contact::cli
