#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "cli/link/client.h"
#include "cli/link/reconnection.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// What Download fetches, and for how long it tries.
struct DownloadOptions {
  /// `jobs/ID`.
  std::string job;
  /// The name of the artifact, such as `trajectory.csv`.
  std::string artifact;
  /// The file to write. What has come so far is in `path`.part.
  std::string path;
  /// When to give up; never, if unset.
  std::optional<std::chrono::steady_clock::time_point> deadline;
  /// Asked about ten times a second; true ends the download.
  std::function<bool()> stopped = [] { return false; };
  /// Called when the connection is lost, once however many attempts follow.
  std::function<void(const std::string& why)> lost = [](const std::string&) {};
  /// Called when more comes after that.
  std::function<void()> regained = [] {};
  /// With a server that cannot be reached.
  Patience patience = {};
};

/// Fetches an artifact into a file, across connections. A part that an earlier download has left is
/// kept, and only the rest fetched; the whole must have the SHA-256 that the server tells, or the
/// part is thrown away. Throws CallFailure as Watch does, and Failure: kLocal for the file,
/// kTimeout and kInterrupted, kRunFailed for bytes that are not those of the server.
v1::Artifact Download(Client& client, const DownloadOptions& options);

}  // namespace contact::cli
