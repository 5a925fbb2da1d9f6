// Text of a scenario file: every mistake has its place, and nothing but a Failure is thrown.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "cli/base/failure.h"
#include "cli/input/scenario_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    contact::cli::ScenarioFile file("fuzz.yaml",
                                    std::string(reinterpret_cast<const char*>(data), size));
    file.Check();
    for (const contact::cli::Diagnostic& mistake : file.diagnostics())
      if (mistake.what.empty()) std::abort();
  } catch (const contact::cli::Failure&) {
  }
  return 0;
}
