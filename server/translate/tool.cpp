#include "translate/tool.h"

#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>

#include "base/spelling.h"

namespace contact::translate {

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

const Tool* FindTool(std::string_view name) {
  const auto found = std::ranges::find(Tools(), name, &Tool::name);
  return found == Tools().end() ? nullptr : &*found;
}

std::string ToolHint(std::string_view name) {
  std::vector<std::string_view> names;
  for (const Tool& tool : Tools()) names.push_back(tool.name);
  return DidYouMean(name, names, fmt::format("{}", fmt::join(names, ", ")));
}

std::string LineOf(const Tool& tool, const std::vector<double>& values) {
  fmt::dynamic_format_arg_store<fmt::format_context> arguments;
  for (std::size_t i = 0; i < values.size(); ++i) {
    arguments.push_back(
        fmt::arg(std::string(tool.parameters[i].name).c_str(), fmt::format("{:.10g}", values[i])));
  }
  return fmt::vformat(tool.line, arguments);
}

}  // namespace contact::translate
