#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/help/contract/glossary.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

void PrintWords(const std::vector<Word>& words, const Style& style) {
  for (const Word& word : words) {
    fmt::print("{}  ({})\n{}", Paint(word.name, Tone::kStrong, style), word.of,
               Wrap(word.text + "\n", style));
  }
}

// All words, below the sentence that says what they tell.
void PrintAll(const std::vector<WordList>& glossary, const Style& style) {
  for (const WordList& list : glossary) {
    fmt::print("{}{}\n", &list == &glossary.front() ? "" : "\n",
               Wrap(fmt::format("{}: {}\n", list.name, list.text), style));
    PrintWords(list.words, style);
  }
}

std::string Json(const std::vector<Word>& words) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Word& word : words) {
    json.push_back({{"word", word.name}, {"of", word.of}, {"text", word.text}});
  }
  return json.dump(2) + "\n";
}

// The words that were asked for, or all.
std::vector<Word> Asked(const std::vector<WordList>& glossary,
                        const std::vector<std::string>& names) {
  std::vector<Word> words;
  const auto add = [&words](const std::vector<Word>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  for (const std::string& name : names) add(FindWords(glossary, name));
  for (const WordList& list : glossary) add(names.empty() ? list.words : std::vector<Word>());
  return words;
}

ExitCode Explain(const std::vector<std::string>& words, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  const std::vector<WordList> glossary = Glossary(Contract());
  if (settings.output == OutputFormat::kJson) {
    PrintJson(Json(Asked(glossary, words)), settings);
  } else if (words.empty()) {
    PrintAll(glossary, settings.OutputStyle());
  } else {
    PrintWords(Asked(glossary, words), settings.OutputStyle());
  }
  return ExitCode::kOk;
}

}  // namespace

void AddExplain(CommandLine& line, CLI::App& command) {
  auto words = std::make_shared<std::vector<std::string>>();
  AddOption(line, command, "WORD", words.get(), ValueKind::kResultWord,
            "Such as INFEASIBLE, NIRV or AUTO; without one all are explained");
  line.SetAction(command, words, Explain);
}

}  // namespace contact::cli
