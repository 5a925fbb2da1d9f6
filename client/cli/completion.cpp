#include "cli/completion.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include "cli/config.h"
#include "cli/paper/items.h"
#include "cli/resolve.h"
#include "cli/scenario_file.h"
#include "cli/settable_fields.h"
#include "cli/templates.h"
#include "contact/v1/event.pb.h"
#include "wire/law_catalogue.h"

namespace contact::cli {
namespace {

struct Candidate {
  std::string text;
  std::string about;
};
using Candidates = std::vector<Candidate>;

// A command line up to the word that is completed.
struct Line {
  CLI::App* command = nullptr;
  std::vector<std::string> positionals;
  CLI::Option* open = nullptr;  ///< The flag whose value comes next.
};

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

// Follows the words as the parser would. Values of global flags are kept, for the server.
Line Follow(CLI::App& app, const std::vector<std::string>& words) {
  Line line{.command = &app, .positionals = {}, .open = nullptr};
  const auto give = [&app](CLI::Option* option, const std::string& value) {
    const auto global = app.get_options();
    if (std::ranges::find(global, option) != global.end()) option->add_result(value);
  };
  for (const std::string& word : words) {
    if (line.open != nullptr) {
      give(line.open, word);
      line.open = nullptr;
    } else if (word.starts_with("-") && word.size() > 1) {
      const std::size_t equals = word.find('=');
      CLI::Option* option = FindFlag(line.command, word.substr(0, equals));
      if (option == nullptr || !TakesValue(*option)) continue;
      if (equals == std::string::npos) {
        line.open = option;
      } else {
        give(option, word.substr(equals + 1));
      }
    } else if (CLI::App* next = FindVerb(line.command, word); next != nullptr) {
      line.command = next;
    } else {
      line.positionals.push_back(word);
    }
  }
  return line;
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

// The words that a validator allows, which it tells in braces.
Candidates Allowed(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}', begin);
  Candidates words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  for (std::size_t at = begin + 1; at < end;) {
    const std::size_t stop = std::min(type.find(',', at), end);
    words.push_back({type.substr(at, stop - at), ""});
    at = stop + 1;
  }
  return words;
}

// A call that takes at most 300 ms and may fail.
template <class Request, class Response>
std::optional<Response> Ask(const Settings& settings,
                            grpc::Status (Client::Stub::*method)(grpc::ClientContext*,
                                                                 const Request&, Response*),
                            const Request& request) {
  constexpr std::chrono::milliseconds kPatience{300};
  Client client(settings.server, kPatience);
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  Response response;
  if (!(client.stub().*method)(&context, request, &response).ok()) return std::nullopt;
  return response;
}

Candidates Jobs(const Settings& settings, const Line&) {
  v1::ListJobsRequest request;
  request.set_page_size(100);
  Candidates jobs;
  const auto answer = Ask(settings, &Client::Stub::ListJobs, request);
  if (!answer) return jobs;
  for (const v1::Job& job : answer->jobs()) {
    jobs.push_back(
        {job.name().substr(job.name().find('/') + 1),
         fmt::format("{} {}", v1::Job::State_Name(job.state()), job.scenario().title())});
  }
  return jobs;
}

Candidates Channels(const Settings& settings, const Line& line) {
  Candidates channels;
  if (line.positionals.empty()) return channels;
  v1::GetSeriesRequest request;
  request.set_name(JobName(line.positionals.front()));
  const auto answer = Ask(settings, &Client::Stub::GetSeries, request);
  if (!answer) return channels;
  for (const auto& column : answer->columns()) {
    if (column.name() != "time") channels.push_back({column.name(), column.unit()});
  }
  return channels;
}

Candidates TemplateNames(const Settings&, const Line&) {
  Candidates names;
  for (const Template& scenario : Templates()) names.push_back({std::string(scenario.name), ""});
  return names;
}

Candidates Laws(const Settings&, const Line&) {
  Candidates laws;
  for (const LawEntry& law : LawCatalogue()) {
    std::string name(law.name());
    std::ranges::transform(name, name.begin(), [](unsigned char c) {
      return c == '_' ? '-' : static_cast<char>(std::tolower(c));
    });
    laws.push_back({name, std::string(law.source)});
  }
  return laws;
}

Candidates States(const Settings&, const Line&) {
  Candidates states;
  const auto& type = *v1::Job::State_descriptor();
  for (int i = 1; i < type.value_count(); ++i) states.push_back({type.value(i)->name(), ""});
  return states;
}

Candidates EventKinds(const Settings&, const Line&) {
  Candidates kinds;
  const auto& payload = *v1::Event::descriptor()->FindOneofByName("payload");
  for (int i = 0; i < payload.field_count(); ++i) kinds.push_back({payload.field(i)->name(), ""});
  return kinds;
}

Candidates Items(const Settings&, const Line&) {
  Candidates items = {{"all", ""}};
  for (const std::string& item : PaperItems()) items.push_back({item, ""});
  return items;
}

Candidates ConfigKeyNames(const Settings&, const Line& line) {
  Candidates keys;
  const CLI::App* root = line.command;
  while (root->get_parent() != nullptr) root = root->get_parent();
  for (const std::string& key : ConfigKeys(*root)) keys.push_back({key, VariableOf(key)});
  return keys;
}

// Profiles are sections of files, whatever else these hold.
Candidates ProfileNames(const Settings& settings, const Line& line) {
  std::vector<std::string> keys;
  for (const Candidate& key : ConfigKeyNames(settings, line)) keys.push_back(key.text);
  Candidates profiles;
  for (const ConfigFile& file : ReadConfigFiles({keys.begin(), keys.end()})) {
    for (const auto& [name, section] : file.profiles) profiles.push_back({name, file.path});
  }
  return profiles;
}

// The fields of the scenario that the line names, or of any; with `=`, the words of one of them.
Candidates Assignments(const Line& line, const std::string& word) {
  v1::Scenario scenario;
  if (!line.positionals.empty() && std::filesystem::is_regular_file(line.positionals.front())) {
    scenario = ScenarioFile::Open(line.positionals.front()).scenario();
  }
  const std::string path = word.substr(0, word.find('='));
  Candidates assignments;
  for (const SettableField& field : SettableFields(scenario)) {
    if (path.size() == word.size()) assignments.push_back({field.path + "=", ""});
    if (path != field.path) continue;
    for (const std::string& value : field.words) assignments.push_back({path + "=" + value, ""});
  }
  return assignments;
}

// What stands for a value in the help tells what it may be.
std::string KindOf(const CLI::Option& option) {
  const std::string type = option.get_type_name().substr(0, option.get_type_name().find(':'));
  return option.get_positional() ? option.get_name() : type;
}

Candidates Values(const CLI::Option& option, const Settings& settings, const Line& line) {
  using Source = Candidates (*)(const Settings&, const Line&);
  static const std::map<std::string, Source> kSources = {
      {"JOB", Jobs},           {"NAME", Channels}, {"TEMPLATE", TemplateNames},
      {"LAW", Laws},           {"STATE", States},  {"KIND,…", EventKinds},
      {"KEY", ConfigKeyNames}, {"ITEM", Items},    {"PROFILE", ProfileNames}};
  const auto source = kSources.find(KindOf(option));
  return source == kSources.end() ? Allowed(option) : source->second(settings, line);
}

std::string Directive(const CLI::Option& option) {
  if (KindOf(option) == "FIELD=VALUE") return ":nospace\n";
  if (KindOf(option) == "DIR") return ":directories\n";
  if (KindOf(option) != "FILE") return ":none\n";
  return option.get_positional() ? ":scenarios\n" : ":files\n";
}

const CLI::Option* Positional(const Line& line) {
  std::vector<const CLI::Option*> positionals;
  for (const CLI::Option* option : line.command->get_options()) {
    if (option->get_positional()) positionals.push_back(option);
  }
  const std::size_t given = line.positionals.size();
  if (given < positionals.size()) return positionals[given];
  const bool many = !positionals.empty() && positionals.back()->get_items_expected_max() > 1;
  return many ? positionals.back() : nullptr;
}

// `prefix` is what the shell takes for part of the word.
std::string Print(const Candidates& candidates, const std::string& prefix,
                  const std::string& begin) {
  std::string text;
  for (const Candidate& candidate : candidates) {
    if (!candidate.text.starts_with(begin)) continue;
    text += fmt::format("{}{}\t{}\n", prefix, candidate.text, FirstSentence(candidate.about));
  }
  return text;
}

// The words as they were before bash split them at `=`.
std::vector<std::string> Joined(const std::vector<std::string>& words) {
  std::vector<std::string> joined;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool part = !joined.empty() && (words[i] == "=" || words[i - 1] == "=");
    if (part) {
      joined.back() += words[i];
    } else {
      joined.push_back(words[i]);
    }
  }
  return joined;
}

// What a shell that splits at `=` takes for the last word: only what stands after it.
void CutAfterEquals(Candidates* candidates) {
  for (Candidate& candidate : *candidates) {
    candidate.text.erase(0, candidate.text.find('=') + 1);
  }
}

}  // namespace

std::string Complete(CLI::App& app, const std::vector<std::string>& split, Settings* settings) try {
  if (split.empty()) return ":none\n";
  const std::vector<std::string> words = Joined(split);
  const bool after_equals = split.back() != words.back();  // All that the shell replaces.
  Line line = Follow(app, {words.begin(), words.end() - 1});
  std::string word = words.back();
  std::string prefix;
  const std::size_t equals = word.find('=');
  if (line.open == nullptr && word.starts_with("--") && equals != std::string::npos) {
    line.open = FindFlag(line.command, word.substr(0, equals));
    if (!after_equals) prefix = word.substr(0, equals + 1);
    word.erase(0, equals + 1);
    if (line.open == nullptr) return ":none\n";
  }
  ResolveSettings(app, settings);
  if (line.open != nullptr && KindOf(*line.open) == "FIELD=VALUE") {
    Candidates assignments = Assignments(line, word);
    std::erase_if(assignments, [&](const auto& a) { return !a.text.starts_with(word); });
    if (after_equals) CutAfterEquals(&assignments);
    return Print(assignments, prefix, "") + Directive(*line.open);
  }
  if (line.open != nullptr) {
    return Print(Values(*line.open, *settings, line), prefix, word) + Directive(*line.open);
  }
  if (word.starts_with("-")) return Print(Flags(*line.command), "", word) + ":none\n";
  const CLI::Option* positional = Positional(line);
  if (positional == nullptr) {
    const bool first = line.positionals.empty();
    return Print(first ? Verbs(*line.command) : Candidates(), "", word) + ":none\n";
  }
  return Print(Values(*positional, *settings, line), "", word) + Directive(*positional);
} catch (const Failure&) {  // Such as an address that is none: nothing to offer.
  return ":none\n";
}

}  // namespace contact::cli
