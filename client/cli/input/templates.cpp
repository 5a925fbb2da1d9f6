#include "cli/input/templates.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "base/spelling.h"
#include "cli/base/failure.h"

namespace contact::cli {

const Template& FindTemplate(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Template& scenario : Templates()) {
    if (scenario.name == name) return scenario;
    names.push_back(scenario.name);
  }
  throw Failure(
      ExitCode::kUsage,
      WithHint(fmt::format("there is no template {}", Quoted(name)),
               DidYouMean(name, names, fmt::format("there are {}", fmt::join(names, ", ")))));
}

}  // namespace contact::cli
