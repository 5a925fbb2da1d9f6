#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "contact/v1/event.pb.h"

namespace contact {

/// How the bytes of a stored event are made. The numbers are in the database.
enum class Coding : int {
  kPlain = 0,   ///< The serialised message.
  kFrames = 1,  ///< A frame chunk, compressed: see README.md.
};

struct CodedEvent {
  Coding coding = Coding::kPlain;
  std::string bytes;
};

/// The same message gives the same bytes.
CodedEvent EncodeEvent(const v1::Event& event);

/// Gives the serialised message. False if the bytes are none that EncodeEvent has made.
bool DecodePayload(Coding coding, std::string bytes, std::string* payload);

/// The same as a message.
bool DecodeEvent(Coding coding, const std::string& bytes, v1::Event* event);

/// Bytes of the event while it is decoded, about; without decoding it.
std::size_t DecodedSize(Coding coding, const std::string& bytes);

}  // namespace contact
