#include "storage/checksum.h"

#include <zlib.h>

namespace contact {
std::int64_t Checksum(const std::string& bytes, std::uint64_t place) {
  const uLong crc = crc32_z(0, reinterpret_cast<const Bytef*>(&place), sizeof place);
  return static_cast<std::int64_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::int64_t Checksum(const CodedEvent& event, std::uint64_t sequence) {
  constexpr int kAboveSequences = 56;  // A log never has so many events.
  return Checksum(event.bytes, sequence | static_cast<std::uint64_t>(event.coding)
                                              << kAboveSequences);
}

}  // namespace contact
