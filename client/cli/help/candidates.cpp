#include "cli/help/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>

#include "cli/base/style.h"
#include "cli/help/contract/glossary.h"
#include "cli/input/scenario_file.h"
#include "cli/input/settable_fields.h"
#include "cli/input/templates.h"
#include "cli/link/connect.h"
#include "cli/link/jobs.h"
#include "cli/settings/resolve.h"
#include "cli/text/render_job.h"
#include "contact/v1/event.pb.h"
#include "wire/scenario/law_catalogue.h"

namespace contact::cli {
namespace {

// A candidate for each item, without a description. `name` makes the text of an item.
template <class Items, class Name = std::identity>
Candidates Named(const Items& items, Name name = {}) {
  Candidates candidates;
  for (const auto& item : items) {
    candidates.push_back({std::string(std::invoke(name, item)), ""});
  }
  return candidates;
}

constexpr std::chrono::milliseconds kPatience{300};

// A call that takes no longer than kPatience. Returns an empty message if it fails.
template <class Request, class Response>
Response Ask(const Settings& settings,
             grpc::Status (Client::Stub::*method)(grpc::ClientContext*, const Request&, Response*),
             const Request& request) {
  Client client(settings.server, kPatience, CredentialsOf(settings));
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kPatience);
  Response response;
  const bool answered = (client.stub().*method)(&context, request, &response).ok();
  return answered ? response : Response();
}

// Asks about the job that the words name; an empty message without one.
template <class Request, class Response>
Response AskOfJob(const Settings& settings, const TypedWords& typed,
                  grpc::Status (Client::Stub::*method)(grpc::ClientContext*, const Request&,
                                                       Response*)) {
  if (typed.positionals.empty()) return {};
  Client client(settings.server, kPatience, CredentialsOf(settings));
  Request request;
  request.set_name(FindJob(client, typed.positionals.front()));
  return Ask(settings, method, request);
}

Candidates Jobs(const Settings& settings, const TypedWords&) {
  v1::ListJobsRequest request;
  request.set_page_size(100);
  const v1::ListJobsResponse answer = Ask(settings, &Client::Stub::ListJobs, request);
  Candidates jobs;
  for (const v1::Job& job : answer.jobs()) {
    jobs.push_back(
        {ShortName(job.name()),
         TrimRight(fmt::format("{} {}", v1::Job::State_Name(job.state()), OneLine(TitleOf(job))))});
  }
  return jobs;
}

Candidates Channels(const Settings& settings, const TypedWords& typed) {
  const v1::Series series = AskOfJob(settings, typed, &Client::Stub::GetSeries);
  Candidates channels;
  for (const auto& column : series.columns()) {
    if (column.name() != "time") channels.push_back({column.name(), column.unit()});
  }
  return channels;
}

// Contacts have a column each of this quantity.
Candidates Contacts(const Settings& settings, const TypedWords& typed) {
  constexpr std::string_view kColumn = ".contact_force";
  const v1::Series series = AskOfJob(settings, typed, &Client::Stub::GetSeries);
  Candidates contacts;
  for (const auto& column : series.columns()) {
    const std::string& name = column.name();
    if (name.ends_with(kColumn)) {
      contacts.push_back({name.substr(0, name.size() - kColumn.size()), ""});
    }
  }
  return contacts;
}

Candidates Artifacts(const Settings& settings, const TypedWords& typed) {
  return Named(AskOfJob(settings, typed, &Client::Stub::GetJob).artifacts(), &v1::Artifact::name);
}

Candidates Metrics(const Settings& settings, const TypedWords& typed) {
  return Named(AskOfJob(settings, typed, &Client::Stub::GetJob).sweep().metrics());
}

Candidates TemplateNames(const Settings&, const TypedWords&) {
  return Named(Templates(), &Template::name);
}

Candidates Laws(const Settings&, const TypedWords&) {
  Candidates laws;
  for (const LawEntry& law : LawCatalogue()) {
    std::string name = boost::to_lower_copy(std::string(law.name));
    std::ranges::replace(name, '_', '-');
    laws.push_back({name, std::string(law.source)});
  }
  return laws;
}

Candidates States(const Settings&, const TypedWords&) { return Named(JobStates()); }

Candidates EventKinds(const Settings&, const TypedWords&) {
  Candidates kinds;
  const auto& payload = *v1::Event::descriptor()->FindOneofByName("payload");
  for (int i = 0; i < payload.field_count(); ++i) kinds.push_back({payload.field(i)->name(), ""});
  return kinds;
}

Candidates Items(const Settings&, const TypedWords&) {
  std::vector<std::string> items = {"all"};
  items.insert(items.end(), PaperItems().begin(), PaperItems().end());
  return Named(items);
}

const CLI::App& RootOf(const TypedWords& typed) {
  const CLI::App* root = typed.command;
  while (root->get_parent() != nullptr) root = root->get_parent();
  return *root;
}

// The words that `help` takes.
Candidates Commands(const Settings&, const TypedWords& typed) {
  Candidates commands = {{"tutorial", "the way from a server to a report"}};
  for (const CLI::App* command : RootOf(typed).get_subcommands({})) {
    commands.push_back({command->get_name(), command->get_description()});
  }
  return commands;
}

// Each word once, with what it is in the first enum that has it.
Candidates ResultWords(const Settings&, const TypedWords&) {
  Candidates words;
  for (const WordList& list : Glossary(Contract())) {
    for (const Word& word : list.words) {
      const bool known = std::ranges::find(words, word.name, &Candidate::text) != words.end();
      if (!known) words.push_back({word.name, word.text});
    }
  }
  return words;
}

Candidates ConfigKeyNames(const Settings&, const TypedWords& typed) {
  Candidates keys;
  for (const std::string& key : ConfigKeys(RootOf(typed))) keys.push_back({key, VariableOf(key)});
  return keys;
}

// The profiles of all config files.
Candidates ProfileNames(const Settings&, const TypedWords& typed) {
  Candidates profiles;
  for (const ConfigFile& file : ConfigFilesOf(RootOf(typed))) {
    for (const auto& [name, section] : file.profiles) profiles.push_back({name, file.path});
  }
  return profiles;
}

}  // namespace

const std::vector<std::string>& PaperItems() {
  static const std::vector<std::string> items = {"fig3",  "fig4",  "fig5",  "exponent", "fig9",
                                                 "fig10", "fig11", "fig12", "table2",   "table3",
                                                 "fig14", "fig15", "fig16", "fig17",    "table4"};
  return items;
}

std::vector<std::string_view> JobStates() {
  std::vector<std::string_view> states;
  const auto& type = *v1::Job::State_descriptor();
  for (int i = 1; i < type.value_count(); ++i) states.push_back(type.value(i)->name());
  return states;
}

Candidates Assignments(const TypedWords& typed, const std::string& word) {
  v1::Scenario scenario;
  if (!typed.positionals.empty() && std::filesystem::is_regular_file(typed.positionals.front())) {
    scenario = ScenarioFile::Open(typed.positionals.front()).scenario();
  }
  const std::string path = word.substr(0, word.find('='));
  Candidates assignments;
  for (const SettableField& field : SettableFields(scenario)) {
    if (path.size() == word.size()) assignments.push_back({field.path + "=", ""});
    if (path != field.path) continue;
    for (const std::string& value : field.words) {
      assignments.push_back({fmt::format("{}={}", path, value), ""});
    }
  }
  return assignments;
}

Candidates Values(const CommandLine& line, const CLI::Option& option, const TypedWords& typed) {
  using Source = Candidates (*)(const Settings&, const TypedWords&);
  static const std::map<ValueKind, Source> kSources = {{ValueKind::kJob, Jobs},
                                                       {ValueKind::kChannel, Channels},
                                                       {ValueKind::kContact, Contacts},
                                                       {ValueKind::kArtifact, Artifacts},
                                                       {ValueKind::kMetric, Metrics},
                                                       {ValueKind::kState, States},
                                                       {ValueKind::kEventKind, EventKinds},
                                                       {ValueKind::kTemplate, TemplateNames},
                                                       {ValueKind::kLaw, Laws},
                                                       {ValueKind::kPaperItem, Items},
                                                       {ValueKind::kConfigKey, ConfigKeyNames},
                                                       {ValueKind::kProfile, ProfileNames},
                                                       {ValueKind::kCommand, Commands},
                                                       {ValueKind::kResultWord, ResultWords}};
  const auto source = kSources.find(line.KindOf(option));
  return source == kSources.end() ? Named(line.WordsOf(option))
                                  : source->second(line.settings(), typed);
}

}  // namespace contact::cli
