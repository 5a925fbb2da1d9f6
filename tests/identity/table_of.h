#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "identity/token_table.h"

namespace contact {

/// The table as a server reads it from the file of these tokens.
inline TokenTable TableOf(const std::vector<TokenRecord>& records) {
  auto table = TokenTable::Parse(TokenTable::Format(records));
  if (const auto* mistake = std::get_if<std::string>(&table)) ADD_FAILURE() << *mistake;
  return std::get<TokenTable>(std::move(table));
}

}  // namespace contact
