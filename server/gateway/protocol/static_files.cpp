#include "gateway/protocol/static_files.h"

#include <absl/strings/ascii.h>
#include <absl/strings/str_split.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "base/file_descriptor.h"

namespace contact::gateway {
namespace {

// The largest file that is served.
constexpr off_t kMostBytes = 16 << 20;

constexpr std::array kTypes = std::to_array<std::pair<std::string_view, std::string_view>>({
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".mjs", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".webmanifest", "application/manifest+json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
    {".csv", "text/csv; charset=utf-8"},
    {".yaml", "application/yaml"},
});

std::string TypeOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension();
  const auto* const found = std::ranges::find(kTypes, ending, &decltype(kTypes)::value_type::first);
  return std::string(found == kTypes.end() ? "application/octet-stream" : found->second);
}

// Opens a file below the directory, by no link and no way out of it.
FileDescriptor OpenBelow(const std::filesystem::path& directory, const std::string& path) {
  const FileDescriptor root(open(directory.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  open_how how = {};
  how.flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS;
  return FileDescriptor(
      static_cast<int>(syscall(SYS_openat2, root.get(), path.c_str(), &how, sizeof(how))));
}

// The last part of a path; empty for a folder.
std::string_view LastPart(std::string_view path) { return path.substr(path.rfind('/') + 1); }

// The relative path of a file that a request names; nothing if it names none.
std::optional<std::string> PathIn(std::string_view target) {
  auto decoded = PercentDecode(target, false);
  if (!decoded || !decoded->starts_with('/') || decoded->find('\0') != std::string::npos ||
      decoded->find('\\') != std::string::npos) {
    return std::nullopt;
  }
  std::string path = decoded->substr(1);
  for (const absl::string_view part : absl::StrSplit(path, '/')) {
    if (absl::StartsWith(part, ".")) return std::nullopt;
  }
  return path;
}

// True if a list of the form `gzip, br;q=0` takes the coding.
bool Takes(std::string_view list, std::string_view coding) {
  for (const absl::string_view entry :
       absl::StrSplit(absl::string_view(list.data(), list.size()), ',')) {
    const std::vector<absl::string_view> parts = absl::StrSplit(entry, ';');
    if (absl::StripAsciiWhitespace(parts.front()) !=
        absl::string_view(coding.data(), coding.size()))
      continue;
    return parts.size() == 1 || absl::StripAsciiWhitespace(parts[1]) != "q=0";
  }
  return false;
}

}  // namespace

std::string_view DashboardFile(std::string_view path) {
  return LastPart(path).find('.') == std::string_view::npos ? "/index.html" : path;
}

std::string DocsFile(std::string_view path) {
  return std::string(path) + (LastPart(path).empty() ? "index.html" : "");
}

StaticFiles::StaticFiles(const std::filesystem::path& directory, std::string missing)
    : missing_(std::move(missing)) {
  std::error_code error;
  if (!directory.empty()) directory_ = std::filesystem::canonical(directory, error);
  if (error) directory_.clear();
}

std::optional<StaticFiles::File> StaticFiles::Read(const std::string& path) const {
  if (directory_.empty()) return std::nullopt;
  const FileDescriptor file = OpenBelow(directory_, path);
  struct stat status = {};
  if (!file.valid() || fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      status.st_size > kMostBytes) {
    return std::nullopt;
  }
  File read;
  read.bytes.resize(static_cast<std::size_t>(status.st_size));
  const ssize_t size = pread(file.get(), read.bytes.data(), read.bytes.size(), 0);
  if (size != status.st_size) return std::nullopt;
  read.etag = fmt::format("\"{:x}-{:x}-{:x}\"", status.st_mtim.tv_sec, status.st_mtim.tv_nsec,
                          status.st_size);
  return read;
}

std::optional<StaticFiles::File> StaticFiles::Choose(const std::string& path,
                                                     const HttpRequest& request,
                                                     std::string* encoding) const {
  for (const auto& [coding, ending] : {std::pair("br", ".br"), std::pair("gzip", ".gz")}) {
    if (!Takes(request.header("accept-encoding"), coding)) continue;
    if (auto file = Read(path + ending)) {
      *encoding = coding;
      return file;
    }
  }
  return Read(path);
}

HttpAnswer StaticFiles::Get(std::string_view name, const HttpRequest& request) const {
  const auto path = PathIn(name);
  std::string encoding;
  auto file = path ? Choose(*path, request, &encoding) : std::nullopt;
  if (!file && path && *path == "index.html") return PlainAnswer(404, missing_);
  if (!file) return PlainAnswer(404, "there is no such file");
  const bool immutable = path->starts_with("assets/");
  HttpAnswer answer{200, {{"content-type", TypeOf(*path)}, {"etag", file->etag}}, ""};
  answer.headers.emplace_back("cache-control",
                              immutable ? "public, max-age=31536000, immutable" : "no-cache");
  answer.headers.emplace_back("vary", "accept-encoding");
  if (!encoding.empty()) answer.headers.emplace_back("content-encoding", encoding);
  if (request.header("if-none-match") == file->etag) {
    answer.status = 304;
  } else {
    answer.body = std::move(file->bytes);
  }
  return answer;
}

}  // namespace contact::gateway
