// Bytes of a Sweep: DecodeSweep reports broken rules, else each cell is a scenario that can be
// checked.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "contact/v1/scenario.pb.h"
#include "wire/sweep/sweep_codec.h"
#include "wire/sweep/sweep_fields.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  contact::v1::Sweep message;
  if (!message.ParseFromArray(data, static_cast<int>(size))) return -1;
  const contact::ScenarioLimits limits{.max_cells = 1000};
  const contact::DecodedSweep decoded = contact::DecodeSweep(message, limits);
  if (!decoded.violations.empty()) return 0;
  std::vector<contact::Violation> none;
  contact::SweepFields fields(message, &none);
  if (!none.empty()) std::abort();
  std::vector<double> last = decoded.axes.Values(decoded.axes.cells() - 1);
  contact::DecodeScenario(fields.Set(last), limits);
  return 0;
}
