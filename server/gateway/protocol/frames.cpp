#include "gateway/protocol/frames.h"

#include <absl/strings/escaping.h>

#include <algorithm>

namespace contact::gateway {
namespace {

constexpr std::size_t kPrefixBytes = 5;

absl::string_view View(std::string_view text) { return {text.data(), text.size()}; }

std::size_t SizeIn(std::string_view prefix) {
  std::size_t size = 0;
  for (std::size_t i = 1; i < kPrefixBytes; ++i) {
    size = size << 8U | static_cast<unsigned char>(prefix[i]);
  }
  return size;
}

}  // namespace

std::array<char, 5> FramePrefix(std::uint8_t flags, std::size_t size) {
  std::array<char, kPrefixBytes> prefix = {static_cast<char>(flags)};
  for (std::size_t i = 1; i < kPrefixBytes; ++i) {
    prefix.at(i) = static_cast<char>(size >> (8 * (kPrefixBytes - 1 - i)) & 0xFFU);
  }
  return prefix;
}

std::size_t FrameBytes(std::string_view begin) {
  return kPrefixBytes + (begin.size() < kPrefixBytes ? 0 : SizeIn(begin));
}

std::string ToBytes(const Frame& frame) {
  const auto prefix = FramePrefix(frame.flags, frame.payload.size());
  return std::string(prefix.data(), prefix.size()) + frame.payload;
}

std::optional<std::vector<Frame>> ToFrames(std::string_view bytes) {
  std::vector<Frame> frames;
  while (!bytes.empty()) {
    if (bytes.size() < kPrefixBytes) return std::nullopt;
    const std::size_t size = SizeIn(bytes);
    if (bytes.size() - kPrefixBytes < size) return std::nullopt;
    frames.push_back(
        {static_cast<std::uint8_t>(bytes.front()), std::string(bytes.substr(kPrefixBytes, size))});
    bytes.remove_prefix(kPrefixBytes + size);
  }
  return frames;
}

std::string ToPaddedBase64(std::string_view bytes) { return absl::Base64Escape(View(bytes)); }

std::string ToBase64(std::string_view bytes) {
  std::string text = ToPaddedBase64(bytes);
  text.erase(std::min(text.find('='), text.size()));
  return text;
}

std::optional<std::string> FromBase64(std::string_view text) {
  std::string standard(text);
  std::ranges::replace(standard, '-', '+');
  std::ranges::replace(standard, '_', '/');
  std::string bytes;
  if (!absl::Base64Unescape(standard, &bytes)) return std::nullopt;
  return bytes;
}

std::optional<std::string> FromBase64Stream(std::string_view text) {
  std::string bytes;
  while (!text.empty()) {
    std::size_t end = std::min(text.find('='), text.size());
    while (end < text.size() && text[end] == '=') ++end;
    const auto part = FromBase64(text.substr(0, end));
    if (!part) return std::nullopt;
    bytes += *part;
    text.remove_prefix(end);
  }
  return bytes;
}

}  // namespace contact::gateway
