#include "cli/help/contract/glossary.h"

#include <fmt/format.h>

#include <array>
#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <string_view>

#include "base/spelling.h"
#include "cli/base/failure.h"

namespace contact::cli {
namespace {

// The enums with words that need an explanation: message and enum.
constexpr std::array<std::array<const char*, 2>, 7> kEnums = {{{"Cycle", "Kind"},
                                                               {"Cycle", "End"},
                                                               {"Cycle", "Status"},
                                                               {"Group", "Growth"},
                                                               {"Solver", "RestitutionScope"},
                                                               {"Job", "State"},
                                                               {"Job", "Convergence"}}};

WordList ListOf(const google::protobuf::EnumDescriptor& type) {
  WordList list{
      fmt::format("{}.{}", type.containing_type()->name(), type.name()), CommentOf(type), {}};
  for (int i = 0; i < type.value_count(); ++i) {
    const auto& value = *type.value(i);
    if (!IsUnspecified(value)) list.words.push_back({value.name(), list.name, CommentOf(value)});
  }
  return list;
}

}  // namespace

std::vector<WordList> Glossary(const Contract& contract) {
  std::vector<WordList> lists;
  for (const auto& [message, name] : kEnums) {
    lists.push_back(ListOf(*contract.Message(message).FindEnumTypeByName(name)));
  }
  return lists;
}

std::vector<Word> FindWords(const std::vector<WordList>& glossary, const std::string& name) {
  std::vector<Word> found;
  std::vector<std::string_view> known;
  for (const WordList& list : glossary) {
    for (const Word& word : list.words) {
      known.push_back(word.name);
      if (boost::iequals(word.name, name)) found.push_back(word);
    }
  }
  if (!found.empty()) return found;
  throw Failure(ExitCode::kUsage, WithHint(fmt::format("{} is no word of results", Quoted(name)),
                                           DidYouMean(boost::to_upper_copy(name), known,
                                                      "contactctl explain shows all words")));
}

}  // namespace contact::cli
