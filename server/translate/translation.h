#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "translate/tool.h"

namespace contact::translate {

/// A contact to translate: what a collision gives back, and how stiff it is.
struct Wanted {
  double restitution = 0;  ///< ε in (0, 1] of the collision without a load.
  double stiffness = 0;    ///< k [N/mⁿ]; 0: `duration` is given.
  double exponent = 1.5;   ///< n that k goes with.
  double duration = 0;     ///< Contact time [s] that every tool is to have; 0: k is given.
};

/// A contact in the parameters of a tool.
struct Translation {
  const Tool* tool = nullptr;
  /// Values of the tool's parameters; empty where there are none, and `missing` or `warnings` says
  /// why.
  std::vector<double> values = {};
  ForceLaw law = {};
  Rebound alone = {};   ///< With these values, without the load.
  Rebound loaded = {};  ///< With the load.
  /// At the step, if one is given and the tool's stepping is known.
  std::optional<SteppedRebound> stepped = {};
  /// What comes of ε as the tool's own restitution, or else of the damping of textbooks for ε.
  std::optional<double> textbook = {};
  std::vector<std::string> warnings = {};
  /// What the setup lacks for this tool: `radius` or `step`; empty if nothing.
  std::string_view missing = {};
};

/// Translates. A tool whose exponent is n has the k that is given; the others have the k with which
/// their contact lasts as long as that of a Hunt–Crossley contact with k, n and ε.
Translation Translate(const Tool& tool, const Wanted& wanted, const Setup& setup);

/// True if these values, ≥ 0, are a spring and a damper that lets something come back. Only then
/// there is something to judge.
bool CanJudge(const Tool& tool, const std::vector<double>& values, const Setup& setup);

/// What a tool does with these values of its parameters.
Translation Judge(const Tool& tool, std::vector<double> values, const Setup& setup);

/// What the setup lacks for a tool: `radius` or `step`; empty if nothing.
std::string_view Missing(const Tool& tool, const Setup& setup);

/// What to give the other tools for the contact that `from` describes without its load.
Wanted WantedOf(const Translation& from);

}  // namespace contact::translate
