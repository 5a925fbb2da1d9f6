#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/protocol/http.h"

namespace contact::gateway {

/// The file of the dashboard that shows a path: `/index.html` for one with no point in its last
/// part.
std::string_view DashboardFile(std::string_view path);

/// The file of the documentation that shows a path below `/docs`: `index.html` for a folder.
std::string DocsFile(std::string_view path);

/// The files of a directory. Reads them when they are asked for. Thread-safe.
class StaticFiles {
 public:
  /// `directory` may be empty or missing: then there are none. `missing` tells a person that
  /// `index.html` is not there.
  StaticFiles(const std::filesystem::path& directory, std::string missing);

  /// The answer to a GET or HEAD for the file of a name, which is percent-encoded and begins with
  /// `/`. Files of `/assets/`, whose names change with what is in them, are kept by clients for
  /// ever, others asked for again with their ETag. A file beside it with `.br` or `.gz` behind its
  /// name is sent instead to who takes that. Nothing outside the directory is ever read, also by no
  /// link.
  HttpAnswer Get(std::string_view name, const HttpRequest& request) const;

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
  const std::string missing_;
};

}  // namespace contact::gateway
