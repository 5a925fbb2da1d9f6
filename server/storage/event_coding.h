#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "contact/v1/event.pb.h"

namespace contact {

/// How the bytes of a stored event are made. The numbers are in the database.
enum class Coding : int {
  /// The serialised message.
  kPlain = 0,
  /// A frame chunk, compressed: see README.md.
  kFrames = 1,
};

/// An event as it is stored.
struct CodedEvent {
  Coding coding = Coding::kPlain;
  std::string bytes;
};

/// Serialises an event, and compresses it if it is a frame chunk whose columns hold one double for
/// each sample. The same message gives the same bytes. Safe to call from any thread, as are the
/// others.
CodedEvent EncodeEvent(const v1::Event& event);

/// Gives the serialised message that EncodeEvent was given. False if the bytes are none that
/// EncodeEvent has made.
bool DecodePayload(Coding coding, std::string bytes, std::string* payload);

/// As DecodePayload, but parses the message into `event`.
bool DecodeEvent(Coding coding, const std::string& bytes, v1::Event* event);

/// About the bytes of the serialised message, told without decoding. Any number if the bytes are
/// none that EncodeEvent has made.
std::size_t DecodedSize(Coding coding, const std::string& bytes);

}  // namespace contact
