#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "translate/stepping.h"

namespace contact::translate {

/// What a simulator's parameters depend on beside the law.
struct Setup {
  Collision collision;
  double radius = 0;  ///< Effective radius R* [m], 1/R* = 1/R_i + 1/R_j; 0: not given.
  double step = 0;    ///< Time step h [s]; 0: not given.
};

/// A parameter of a simulator.
struct ToolParameter {
  std::string_view name;  ///< As the simulator calls it.
  std::string_view unit;  ///< `1` if it has none.
};

/// A contact model of a simulator: its law, and how its parameters stand for it.
struct Tool {
  std::string_view name;   ///< Of the model, such as `lammps-hooke`.
  std::string_view title;  ///< The simulator and the model.
  /// Where the formulas were read: the page or file, and the version of what was run or read.
  std::string_view source;
  /// The law; its stiffness and damping do not count, its full_depth is in units of LengthUnit.
  ForceLaw law;
  Stepping stepping = Stepping::kAccurate;
  bool needs_radius = false, needs_step = false;
  std::vector<ToolParameter> parameters;
  /// Index of the parameter that the simulator calls a restitution; -1: there is none.
  int restitution = -1;
  /// The values of the parameters, in their order, for a law like `law`. NaN: there is no value.
  std::vector<double> (*write)(const ForceLaw& law, const Setup& setup);
  /// The law for values of the parameters; the inverse of `write`. `law` is that of the tool.
  ForceLaw (*read)(ForceLaw law, const std::vector<double>& values, const Setup& setup);
  /// What to write into the simulator's model: a text with {name} for each value.
  std::string_view line;
  /// What the user should know; may be empty.
  std::string_view note;
};

/// Every tool, sorted by name. They live as long as the program.
std::span<const Tool> Tools();

/// The tool with this name; null if there is none.
const Tool* FindTool(std::string_view name);

/// What to do about a name that no tool has: the nearest name, or all names.
std::string ToolHint(std::string_view name);

/// The line of a tool with these values, to ten digits.
std::string LineOf(const Tool& tool, const std::vector<double>& values);

/// Tools of a family, in its file: linear and Hunt–Crossley laws of multibody programs, engines
/// that step over contacts, and programs for granular matter.
std::vector<Tool> MultibodyTools();
std::vector<Tool> EngineTools();
std::vector<Tool> GranularTools();

}  // namespace contact::translate
