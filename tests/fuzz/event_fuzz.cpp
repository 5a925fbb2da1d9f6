// Bytes of a stored event, after a byte that says which coding: what is decoded, encoded and
// decoded again is the same message. Fields of a later contract are left out by EncodeEvent.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "contact/v1/event.pb.h"
#include "storage/event_coding.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  const auto coding = data[0] % 2 == 0 ? contact::Coding::kPlain : contact::Coding::kFrames;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  contact::DecodedSize(coding, bytes);
  contact::v1::Event event;
  if (!contact::DecodeEvent(coding, bytes, &event)) return 0;
  event.DiscardUnknownFields();
  const contact::CodedEvent coded = contact::EncodeEvent(event);
  contact::v1::Event again;
  if (!contact::DecodeEvent(coded.coding, coded.bytes, &again)) std::abort();
  if (again.SerializeAsString() != event.SerializeAsString()) std::abort();
  return 0;
}
