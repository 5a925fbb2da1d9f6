// Bytes of a checkpoint, behind the name of this build: decoded to a state that encodes again, or
// to nothing.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "jobs/run/run_state_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // All that comes before the state: it changes with each commit, so it is not in the corpus.
  static const std::string* const build = [] {
    const std::string empty = contact::EncodeRunState({});
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < sizeof length; ++i)
      length |= std::uint64_t{static_cast<std::uint8_t>(empty[i])} << (8 * i);
    return new std::string(empty, 0, sizeof length + length);
  }();
  const auto state =
      contact::DecodeRunState(*build + std::string(reinterpret_cast<const char*>(data), size));
  if (state && !contact::DecodeRunState(contact::EncodeRunState(*state))) std::abort();
  return 0;
}
