#pragma once

#include <span>
#include <string>
#include <string_view>

namespace contact::cli {

/// A scenario or sweep that is shipped with the program, from client/scenarios.
struct Template {
  /// The name of its file, without `.yaml`.
  std::string_view name;
  /// Its title, or what it sweeps.
  std::string_view shows;
  /// The whole file.
  std::string_view text;
};

/// All of them, in the order in which they are listed.
std::span<const Template> Templates();

/// The template with this name. Throws Failure (kUsage) if there is none.
const Template& FindTemplate(const std::string& name);

}  // namespace contact::cli
