#pragma once

#include <string>
#include <vector>

#include "cli/help/contract/contract.h"

namespace contact::cli {

/// A word that stands in results or chooses how they are made, and what the contract says about it.
struct Word {
  /// As it is printed, such as `INFEASIBLE`.
  std::string name;
  /// The enum that it is a value of, such as `Cycle.Status`.
  std::string of;
  /// Its comment in the contract.
  std::string text;
};

/// Words of one enum.
struct WordList {
  /// Such as `Cycle.Status`.
  std::string name;
  /// The comment of the enum.
  std::string text;
  /// In the order of the contract, without the value for none.
  std::vector<Word> words;
};

/// How cycles begin and end, what became of them and of their groups, which cycles share a group,
/// and how jobs end.
std::vector<WordList> Glossary(const Contract& contract);

/// The words with this name, in any case: several if several enums have one. Throws Failure
/// (kUsage), which suggests the nearest one, if there is none.
std::vector<Word> FindWords(const std::vector<WordList>& glossary, const std::string& name);

}  // namespace contact::cli
