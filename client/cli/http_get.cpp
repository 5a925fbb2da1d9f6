#include "cli/http_get.h"

#include <curl/curl.h>
#include <fmt/format.h>

#include <cstddef>
#include <memory>

#include "cli/failure.h"

namespace contact::cli {
namespace {

std::size_t Append(const char* data, std::size_t size, std::size_t count, void* page) {
  static_cast<std::string*>(page)->append(data, size * count);
  return size * count;
}

}  // namespace

std::string HttpGet(const std::string& address, const std::string& path,
                    std::chrono::milliseconds timeout) {
  const std::unique_ptr<CURL, void (*)(CURL*)> curl(curl_easy_init(), curl_easy_cleanup);
  const std::string url = fmt::format("http://{}{}", address, path);
  std::string page;
  if (!curl) throw Failure(ExitCode::kLocal, "libcurl cannot be started");
  curl_easy_setopt(curl.get(), CURLOPT_URL, url.c_str());
  curl_easy_setopt(curl.get(), CURLOPT_PROTOCOLS_STR, "http");
  curl_easy_setopt(curl.get(), CURLOPT_NOPROXY, "*");
  curl_easy_setopt(curl.get(), CURLOPT_NOSIGNAL, 1L);
  curl_easy_setopt(curl.get(), CURLOPT_TIMEOUT_MS, static_cast<long>(timeout.count()));
  curl_easy_setopt(curl.get(), CURLOPT_WRITEFUNCTION, Append);
  curl_easy_setopt(curl.get(), CURLOPT_WRITEDATA, &page);
  const CURLcode result = curl_easy_perform(curl.get());
  if (result == CURLE_OPERATION_TIMEDOUT) {
    throw Failure(ExitCode::kTimeout, fmt::format("{}: no answer in time", url));
  }
  if (result != CURLE_OK) {
    throw Failure(ExitCode::kUnreachable, fmt::format("{}: {}", url, curl_easy_strerror(result)));
  }
  long status = 0;
  curl_easy_getinfo(curl.get(), CURLINFO_RESPONSE_CODE, &status);
  if (status != 200) {
    throw Failure(ExitCode::kUnreachable, fmt::format("{}: answers with status {}", url, status));
  }
  return page;
}

}  // namespace contact::cli
