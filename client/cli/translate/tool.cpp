#include "cli/translate/tool.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/spelling.h"
#include "cli/base/failure.h"

namespace contact::cli {

std::span<const Tool> Tools() {
  static const std::vector<Tool> tools = [] {
    std::vector<Tool> all = MultibodyTools();
    std::ranges::move(EngineTools(), std::back_inserter(all));
    std::ranges::move(GranularTools(), std::back_inserter(all));
    std::ranges::sort(all, {}, &Tool::name);
    return all;
  }();
  return tools;
}

const Tool& FindTool(const std::string& name) {
  std::vector<std::string_view> names;
  for (const Tool& tool : Tools()) {
    if (tool.name == name) return tool;
    names.push_back(tool.name);
  }
  throw Failure(ExitCode::kUsage,
                WithHint(fmt::format("there is no tool {}", Quoted(name)),
                         DidYouMean(name, names, fmt::format("{}", fmt::join(names, ", ")))));
}

std::string LineOf(const Tool& tool, const std::vector<double>& values) {
  fmt::dynamic_format_arg_store<fmt::format_context> arguments;
  for (std::size_t i = 0; i < values.size(); ++i) {
    arguments.push_back(
        fmt::arg(std::string(tool.parameters[i].name).c_str(), fmt::format("{:.10g}", values[i])));
  }
  return fmt::vformat(tool.line, arguments);
}

}  // namespace contact::cli
