#pragma once

#include <string>
#include <vector>

#include "cli/help/contract/contract.h"

namespace contact::cli {

/// Something that has a name in a scenario file, and what the contract says of it.
struct Term {
  std::string name;
  std::string type;          ///< Of a field; empty for the value of an enum.
  std::string text;          ///< As CommentOf gives it.
  std::vector<Term> values;  ///< Of a field that is an enum.
};

/// A message of the contract.
struct Chapter {
  std::string name;  ///< Such as `Load.Sine`.
  std::string text;
  std::vector<Term> fields;
};

/// All that a scenario or sweep file may hold, from the whole to its parts.
std::vector<Chapter> ScenarioReference(const Contract& contract);

/// The same as a page in Markdown, client/scenarios/README.md.
std::string ReferenceInMarkdown(const std::vector<Chapter>& chapters);

}  // namespace contact::cli
