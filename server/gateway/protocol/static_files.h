#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "gateway/protocol/http.h"

namespace contact::gateway {

/// The files of the dashboard. Reads them when they are asked for. Thread-safe.
class StaticFiles {
 public:
  /// `directory` may be empty or missing: then there are none.
  explicit StaticFiles(const std::filesystem::path& directory);

  /// The answer to a GET or HEAD. A path with no point in its last part is the page `index.html`,
  /// which shows what the path says. Files of `/assets/`, whose names change with what is in them,
  /// are kept by clients for ever, others asked for again with their ETag. A file beside it with
  /// `.br` or `.gz` behind its name is sent instead to who takes that. Nothing outside the
  /// directory is ever read, also by no link.
  HttpAnswer Get(const HttpRequest& request) const;

 private:
  struct File {
    std::string bytes;
    std::string etag;
  };
  /// Reads a file of the directory by its relative path; nothing if there is none.
  std::optional<File> Read(const std::string& path) const;
  /// The file, or a compressed one that the request takes; `encoding` is then set.
  std::optional<File> Choose(const std::string& path, const HttpRequest& request,
                             std::string* encoding) const;

  /// Without links; empty: none.
  std::filesystem::path directory_;
};

}  // namespace contact::gateway
