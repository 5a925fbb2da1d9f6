#include "cli/help/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "cli/help/candidates.h"
#include "cli/settings/resolve.h"

namespace contact::cli {
namespace {

bool TakesValue(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

CLI::Option* FindFlag(CLI::App* command, const std::string& name) {
  for (CLI::App* scope = command; scope != nullptr; scope = scope->get_parent()) {
    for (CLI::Option* option : scope->get_options()) {
      if (!option->get_positional() && option->check_name(name)) return option;
    }
  }
  return nullptr;
}

CLI::App* FindVerb(CLI::App* command, const std::string& name) {
  for (CLI::App* verb : command->get_subcommands({})) {
    if (verb->check_name(name)) return verb;
  }
  return nullptr;
}

// Gives the option its value if it is a global flag, such as --server, for the calls that
// completion makes.
void KeepGlobal(const CLI::App& app, CLI::Option* option, const std::string& value) {
  const auto global = app.get_options();
  if (std::ranges::find(global, option) == global.end()) return;
  option->add_result(value);
  option->run_callback();
}

// Reads the words as the parser would.
TypedWords Follow(CLI::App& app, const std::vector<std::string>& words) {
  TypedWords typed{.command = &app, .positionals = {}, .open = nullptr};
  for (const std::string& word : words) {
    if (typed.open != nullptr) {
      KeepGlobal(app, std::exchange(typed.open, nullptr), word);
    } else if (word.starts_with("-") && word.size() > 1) {
      const std::size_t equals = word.find('=');
      CLI::Option* option = FindFlag(typed.command, word.substr(0, equals));
      if (option == nullptr || !TakesValue(*option)) continue;
      if (equals == std::string::npos) {
        typed.open = option;
      } else {
        KeepGlobal(app, option, word.substr(equals + 1));
      }
    } else if (CLI::App* next = FindVerb(typed.command, word); next != nullptr) {
      typed.command = next;
    } else {
      typed.positionals.push_back(word);
    }
  }
  return typed;
}

std::string FirstSentence(const std::string& text) { return text.substr(0, text.find('\n')); }

Candidates Verbs(const CLI::App& command) {
  Candidates verbs;
  for (const CLI::App* verb : command.get_subcommands({})) {
    if (!verb->get_group().empty()) {
      verbs.push_back({verb->get_name(), FirstSentence(verb->get_description())});
    }
  }
  return verbs;
}

Candidates Flags(const CLI::App& command) {
  Candidates flags;
  for (const CLI::App* scope = &command; scope != nullptr; scope = scope->get_parent()) {
    for (const CLI::Option* option : scope->get_options()) {
      if (option->get_lnames().empty() || option->get_group().empty()) continue;
      const Candidate flag{"--" + option->get_lnames().front(), option->get_description()};
      if (std::ranges::find(flags, flag.text, &Candidate::text) == flags.end()) {
        flags.push_back(flag);
      }
    }
  }
  return flags;
}

std::string Directive(const CommandLine& line, const CLI::Option& option) {
  if (IsList(option)) return ":nospace\n";
  switch (line.KindOf(option)) {
    case ValueKind::kAssignment:
      return ":nospace\n";
    case ValueKind::kDirectory:
      return ":directories\n";
    case ValueKind::kScenarioFile:
      return ":scenarios\n";
    case ValueKind::kFile:
      return ":files\n";
    default:
      return ":none\n";
  }
}

const CLI::Option* Positional(const TypedWords& typed) {
  const auto positionals = typed.command->get_options(
      [](const CLI::Option* option) { return option->get_positional(); });
  const std::size_t given = typed.positionals.size();
  if (given < positionals.size()) return positionals[given];
  const bool many = !positionals.empty() && positionals.back()->get_items_expected_max() > 1;
  return many ? positionals.back() : nullptr;
}

// A line for each candidate that begins with `begin`. `prefix` precedes each, because the shell
// takes it for part of the word.
std::string Print(const Candidates& candidates, const std::string& prefix,
                  const std::string& begin) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    if (!candidate.text.starts_with(begin)) continue;
    text += fmt::format("{}{}\t{}\n", prefix, candidate.text, FirstSentence(candidate.about));
  }
  return text;
}

// The values of an option. Those of a list are for its last entry; entries that stand before it
// are left out.
std::string PrintValues(const CommandLine& line, const CLI::Option& option, const TypedWords& typed,
                        const std::string& prefix, const std::string& word) {
  Candidates values = Values(line, option, typed);
  const std::size_t entry = IsList(option) ? word.rfind(',') + 1 : 0;
  const std::string given = fmt::format(",{}", word.substr(0, entry));
  std::erase_if(values, [&given](const Candidate& value) {
    return given.find(fmt::format(",{},", value.text)) != std::string::npos;
  });
  return Print(values, prefix + word.substr(0, entry), word.substr(entry)) +
         Directive(line, option);
}

// Joins words that bash has split at `=`.
std::vector<std::string> Joined(const std::vector<std::string>& words) {
  std::vector<std::string> joined;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool part = !joined.empty() && (words[i] == "=" || words[i - 1] == "=");
    if (!part) joined.emplace_back();
    joined.back() += words[i];
  }
  return joined;
}

// FIELD=VALUE, or only VALUE for a shell that splits words at `=` and replaces what follows it.
std::string PrintAssignments(const TypedWords& typed, const std::string& word,
                             const std::string& prefix, bool after_equals) {
  Candidates assignments = Assignments(typed, word);
  std::erase_if(assignments, [&word](const auto& a) { return !a.text.starts_with(word); });
  for (Candidate& candidate : assignments) {
    if (after_equals) candidate.text.erase(0, candidate.text.find('=') + 1);
  }
  return Print(assignments, prefix, "");
}

// What may follow the words if it is neither a flag nor the value of one.
std::string PrintNext(const CommandLine& line, const TypedWords& typed, const std::string& word) {
  if (word.starts_with("-")) return Print(Flags(*typed.command), "", word) + ":none\n";
  if (const CLI::Option* positional = Positional(typed)) {
    return PrintValues(line, *positional, typed, "", word);
  }
  const Candidates verbs = typed.positionals.empty() ? Verbs(*typed.command) : Candidates();
  return Print(verbs, "", word) + ":none\n";
}

}  // namespace

std::string Complete(CommandLine& line, const std::vector<std::string>& split) try {
  if (split.empty()) return ":none\n";
  const std::vector<std::string> words = Joined(split);
  const bool after_equals =
      split.back() != words.back();  // Then the shell replaces only the value.
  TypedWords typed = Follow(line.app(), {words.begin(), words.end() - 1});
  std::string word = words.back();
  std::string prefix;
  const std::size_t equals = word.find('=');
  if (typed.open == nullptr && word.starts_with("--") && equals != std::string::npos) {
    typed.open = FindFlag(typed.command, word.substr(0, equals));
    if (!after_equals) prefix = word.substr(0, equals + 1);
    word.erase(0, equals + 1);
    if (typed.open == nullptr) return ":none\n";
  }
  ResolveSettings(line.app(), &line.settings());
  if (typed.open == nullptr) return PrintNext(line, typed, word);
  if (line.KindOf(*typed.open) != ValueKind::kAssignment) {
    return PrintValues(line, *typed.open, typed, prefix, word);
  }
  return PrintAssignments(typed, word, prefix, after_equals) + Directive(line, *typed.open);
} catch (const Failure&) {  // Such as a wrong address: there is nothing to offer.
  return ":none\n";
} catch (const CLI::Error&) {  // The value of a global flag is none.
  return ":none\n";
}

}  // namespace contact::cli
