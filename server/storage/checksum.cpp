#include "storage/checksum.h"

#include <zlib.h>

namespace contact {
namespace {

const Bytef* Start(const std::string& bytes) {
  return reinterpret_cast<const Bytef*>(bytes.data());
}

}  // namespace

std::int64_t Checksum(const std::string& bytes, std::uint64_t place, const std::string& job) {
  uLong crc = crc32_z(0, Start(job), job.size());
  crc = crc32_z(crc, reinterpret_cast<const Bytef*>(&place), sizeof place);
  return static_cast<std::int64_t>(crc32_z(crc, Start(bytes), bytes.size()));
}

std::int64_t Checksum(const CodedEvent& event, std::uint64_t sequence, const std::string& job) {
  constexpr int kAboveSequences = 56;  // A log never has so many events.
  const auto coding = static_cast<std::uint64_t>(event.coding) << kAboveSequences;
  return Checksum(event.bytes, sequence | coding, job);
}

bool Passes(std::int64_t crc32, const std::string& bytes, const std::string& job) {
  return crc32 == Checksum(bytes, 0, job) || crc32 == Checksum(bytes);
}

bool Passes(std::int64_t crc32, const CodedEvent& event, std::uint64_t sequence,
            const std::string& job) {
  return crc32 == Checksum(event, sequence, job) || crc32 == Checksum(event, sequence);
}

}  // namespace contact
