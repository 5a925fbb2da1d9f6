#pragma once

#include <yaml-cpp/yaml.h>

#include <CLI/App.hpp>
#include <map>
#include <string>
#include <vector>

#include "cli/input/yaml_reader.h"

namespace contact::cli {

/// Values of variables by name, as text.
using VariableValues = std::map<std::string, std::string>;

/// Adds --var to a command; its texts are for ParseVariables.
void AddVariableFlag(CLI::App& command, std::vector<std::string>* assignments);

/// Reads NAME=VALUE texts. Throws Failure (kUsage) for a text that is none.
VariableValues ParseVariables(const std::vector<std::string>& assignments);

/// Takes the mapping `variables` out of a document and puts its values, or those in `given`, where
/// `${name}` stands in a value; `$${` stands for `${`. Places are kept. Reports mistakes, such as a
/// name that the mapping lacks. Returns the values, also those that are nowhere used. A document
/// without `variables` stays as it is.
VariableValues ResolveVariables(const VariableValues& given, const YamlReader::Report& report,
                                YAML::Node* document);

/// Throws Failure (kUsage) unless each of `given` is among `known`.
void RequireKnown(const VariableValues& given, const VariableValues& known);

}  // namespace contact::cli
