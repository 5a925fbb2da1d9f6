#include "gateway/protocol/metadata.h"

#include <absl/strings/ascii.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_split.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "gateway/protocol/frames.h"

namespace contact::gateway {
namespace {

constexpr std::array<std::string_view, 22> kOfHttp = {"host",
                                                      "connection",
                                                      "keep-alive",
                                                      "te",
                                                      "trailer",
                                                      "upgrade",
                                                      "transfer-encoding",
                                                      "expect",
                                                      "content-type",
                                                      "content-length",
                                                      "content-encoding",
                                                      "user-agent",
                                                      "origin",
                                                      "referer",
                                                      "cookie",
                                                      "cache-control",
                                                      "pragma",
                                                      "dnt",
                                                      "priority",
                                                      "forwarded",
                                                      "via",
                                                      "upgrade-insecure-requests"};
constexpr std::array<std::string_view, 8> kPrefixesOfHttp = {
    "accept", "sec-", "proxy-", "connect-", "grpc-", "x-contactd-", "x-forwarded-", "if-"};

bool IsOfHttp(std::string_view name) {
  return std::ranges::find(kOfHttp, name) != kOfHttp.end() ||
         std::ranges::any_of(kPrefixesOfHttp,
                             [name](auto prefix) { return name.starts_with(prefix); });
}

bool IsName(std::string_view name) {
  return std::ranges::all_of(name, [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return absl::ascii_islower(byte) || absl::ascii_isdigit(byte) || c == '-' || c == '_' ||
           c == '.';
  });
}

bool IsPrintable(std::string_view value) {
  return std::ranges::all_of(value, [](char c) { return c >= ' ' && c <= '~'; });
}

// Adds each of the values of a `-bin` header, which commas part. False: one is no base64.
bool AddBytes(const std::string& name, const std::string& value, Metadata* metadata) {
  for (const absl::string_view part : absl::StrSplit(value, ',')) {
    const absl::string_view text = absl::StripAsciiWhitespace(part);
    auto bytes = FromBase64({text.data(), text.size()});
    if (!bytes) return false;
    metadata->emplace_back(name, *std::move(bytes));
  }
  return true;
}

// The number of up to `most` digits, with nothing else.
std::optional<std::int64_t> Digits(std::string_view text, std::size_t most) {
  const bool digits = std::ranges::all_of(
      text, [](char c) { return absl::ascii_isdigit(static_cast<unsigned char>(c)); });
  std::int64_t number = 0;
  if (!digits || text.size() > most || !absl::SimpleAtoi({text.data(), text.size()}, &number)) {
    return std::nullopt;
  }
  return number;
}

}  // namespace

std::optional<Metadata> ToMetadata(const Headers& headers, std::string* mistake) {
  Metadata metadata;
  for (const auto& [name, value] : headers) {
    if (IsOfHttp(name)) continue;
    const bool bytes = name.ends_with("-bin");
    if (!IsName(name) || (!bytes && !IsPrintable(value))) {
      *mistake = fmt::format(
          "header '{}' cannot be metadata: its name or value has characters "
          "that gRPC does not take",
          PercentEncode(name));
      return std::nullopt;
    }
    if (!bytes) {
      metadata.emplace_back(name, value);
    } else if (!AddBytes(name, value, &metadata)) {
      *mistake = fmt::format("header '{}' is not base64", name);
      return std::nullopt;
    }
  }
  return metadata;
}

Headers ToHeaders(const std::multimap<grpc::string_ref, grpc::string_ref>& metadata,
                  std::string_view prefix) {
  Headers headers;
  for (const auto& [key, text] : metadata) {
    const std::string name(key.data(), key.size());
    const std::string value(text.data(), text.size());
    if (IsOfHttp(name) || name.starts_with(':')) continue;
    headers.emplace_back(std::string(prefix) + name,
                         name.ends_with("-bin") ? ToBase64(value) : value);
  }
  return headers;
}

std::optional<std::int64_t> ConnectTimeout(std::string_view text) { return Digits(text, 10); }

std::optional<std::int64_t> GrpcTimeout(std::string_view text) {
  if (text.empty()) return std::nullopt;
  const auto number = Digits(text.substr(0, text.size() - 1), 8);
  if (!number) return std::nullopt;
  switch (text.back()) {
    case 'H':
      return *number * 3'600'000;
    case 'M':
      return *number * 60'000;
    case 'S':
      return *number * 1000;
    case 'm':
      return *number;
    case 'u':
      return (*number + 999) / 1000;
    case 'n':
      return (*number + 999'999) / 1'000'000;
    default:
      return std::nullopt;
  }
}

}  // namespace contact::gateway
