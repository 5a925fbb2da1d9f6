#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace contact::gateway {

/// Flags of a frame.
enum FrameFlag : std::uint8_t {
  kCompressed = 0x01,   ///< Of both protocols.
  kEndOfStream = 0x02,  ///< Of Connect: the payload is the end in JSON.
  kTrailers = 0x80,     ///< Of gRPC-Web: the payload has the trailers.
};

/// A part of a stream: a byte of flags, four of length, big-endian, and the payload.
struct Frame {
  std::uint8_t flags = 0;
  std::string payload = {};
};

/// What goes before a payload of this size.
std::array<char, 5> FramePrefix(std::uint8_t flags, std::size_t size);

/// Size of the frame that begins so, with its prefix; that of the prefix if not all of it is there.
std::size_t FrameBytes(std::string_view begin);

/// The frame as bytes.
std::string ToBytes(const Frame& frame);

/// All frames in the bytes; nothing if the last one is not complete.
std::optional<std::vector<Frame>> ToFrames(std::string_view bytes);

/// Base64 without padding.
std::string ToBase64(std::string_view bytes);
/// Base64 with padding.
std::string ToPaddedBase64(std::string_view bytes);
/// The bytes of a text in base64, also URL-safe, with or without padding; nothing if it is none.
std::optional<std::string> FromBase64(std::string_view text);
/// The bytes of texts in padded base64 behind one another, as gRPC-Web's text streams are.
std::optional<std::string> FromBase64Stream(std::string_view text);

}  // namespace contact::gateway
