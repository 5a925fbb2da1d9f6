#pragma once

#include <yaml-cpp/yaml.h>

#include <map>
#include <string>
#include <vector>

#include "cli/input/yaml_reader.h"

namespace contact::cli {

/// Values of variables by name, as text.
using VariableValues = std::map<std::string, std::string>;

/// Reads the NAME=VALUE texts of --var. Throws Failure (kUsage) for a text that is none.
VariableValues ParseVariables(const std::vector<std::string>& assignments);

/// By the name of a variable the paths of the fields whose whole value it is, such as
/// `bodies[0].mass_kg`. Has every variable of a document.
using VariableFields = std::map<std::string, std::vector<std::string>>;

/// Takes the mapping `variables` out of a document and puts its values, or those in `given`, where
/// `${name}` stands in a value; `$${` stands for `${`. Places are kept. Reports mistakes, such as a
/// name that the mapping lacks, and advises on variables that are used nowhere. Returns the
/// variables. A document without `variables` stays as it is.
VariableFields ResolveVariables(const VariableValues& given, const YamlReader::Report& report,
                                const YamlReader::Report& advise, YAML::Node* document);

/// Throws Failure (kUsage) unless each of `given` is among `known`.
void RequireKnown(const VariableValues& given, const VariableFields& known);

/// Hint for a variable that is not among `known`: the nearest name, or all names.
std::string KnownVariables(const std::string& name, const VariableFields& known);

}  // namespace contact::cli
