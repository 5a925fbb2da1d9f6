#include "storage/records.h"

namespace contact {

bool StoredEvent::Parse(v1::Event* event) const {
  return intact && DecodeEvent(coding, bytes, event);
}

bool StoredEvent::TakePayload(std::string* payload) {
  return intact && DecodePayload(coding, std::move(bytes), payload);
}

}  // namespace contact
