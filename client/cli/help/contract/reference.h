#pragma once

#include <string>
#include <vector>

#include "cli/help/contract/contract.h"

namespace contact::cli {

/// A name in a scenario file, of a field or of the value of an enum, and what the contract says
/// about it.
struct Term {
  std::string name;
  std::string type;          ///< Type in words, such as `list of Body`; empty for an enum's value.
  std::string text;          ///< FieldText of a field, CommentOf of a value.
  std::vector<Term> values;  ///< Values of a field that is an enum; else empty.
};

/// A message of the contract.
struct Chapter {
  std::string name;          ///< ShortTypeName, such as `Load.Sine`.
  std::string text;          ///< Its comment, and the choices between its fields.
  std::vector<Term> fields;  ///< In the order of the contract.
};

/// All messages that a scenario or sweep file may hold, each before the messages in its fields.
std::vector<Chapter> ScenarioReference(const Contract& contract);

/// The chapters as the page client/scenarios/README.md, in Markdown.
std::string ReferenceInMarkdown(const std::vector<Chapter>& chapters);

}  // namespace contact::cli
