// Bytes of a Scenario: DecodeScenario reports broken rules, else the values are good enough for
// advice and estimate.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "contact/v1/scenario.pb.h"
#include "wire/estimate.h"
#include "wire/scenario/scenario_codec.h"
#include "wire/scenario_advice.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  contact::v1::Scenario message;
  if (!message.ParseFromArray(data, static_cast<int>(size))) return -1;
  const contact::DecodedScenario decoded = contact::DecodeScenario(message);
  if (!decoded.violations.empty()) return 0;
  contact::Advise(message, decoded.scenario);
  if (contact::EstimateRun(decoded.scenario).memory_bytes() < 0) std::abort();
  return 0;
}
