#pragma once

#include <string>
#include <vector>

#include "cli/help/contract/contract.h"

namespace contact::cli {

/// A name in a scenario file, of a field or of the value of an enum, and what the contract says
/// about it.
struct Term {
  /// As it is written in a file.
  std::string name;
  /// Type in words, such as `list of Body`; empty for the value of an enum.
  std::string type;
  /// FieldText of a field, CommentOf of a value.
  std::string text;
  /// Values of a field that is an enum; else empty.
  std::vector<Term> values;
};

/// A message of the contract.
struct Chapter {
  /// ShortTypeName, such as `Load.Sine`.
  std::string name;
  /// The comment of the message, and the choices between its fields.
  std::string text;
  /// In the order of the contract.
  std::vector<Term> fields;
};

/// All messages that a scenario or sweep file may hold, each before the messages in its fields.
std::vector<Chapter> ScenarioReference(const Contract& contract);

/// The chapters as the page client/scenarios/README.md, in Markdown.
std::string ReferenceInMarkdown(const std::vector<Chapter>& chapters);

}  // namespace contact::cli
