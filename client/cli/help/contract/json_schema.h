#pragma once

#include <string>

#include "cli/help/contract/contract.h"

namespace contact::cli {

/// A JSON Schema, draft-07, of what contactctl reads or prints, as indented text. Descriptions come
/// from the comments of the contract; ranges, defaults and required fields from its rules. Unknown
/// fields are refused. `kind` is `scenario`, a scenario file; `sweep`, a sweep file, whose base may
/// be the name of a scenario file; or `job`, what `-o json` prints.
std::string JsonSchema(const Contract& contract, const std::string& kind);

}  // namespace contact::cli
