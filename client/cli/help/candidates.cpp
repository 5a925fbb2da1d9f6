#include "cli/help/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>

#include "cli/input/scenario_file.h"
#include "cli/input/settable_fields.h"
#include "cli/input/templates.h"
#include "cli/link/job_names.h"
#include "cli/paper/items.h"
#include "cli/settings/config.h"
#include "cli/settings/resolve.h"
#include "contact/v1/event.pb.h"
#include "wire/scenario/law_catalogue.h"

namespace contact::cli {
namespace {

Candidates Words(const CommandLine& line, const CLI::Option& option) {
  Candidates words;
  for (const std::string& word : line.WordsOf(option)) words.push_back({word, ""});
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

Candidates Jobs(const Settings& settings, const TypedWords&) {
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

Candidates Channels(const Settings& settings, const TypedWords& typed) {
  Candidates channels;
  if (typed.positionals.empty()) return channels;
  v1::GetSeriesRequest request;
  request.set_name(JobName(typed.positionals.front()));
  const auto answer = Ask(settings, &Client::Stub::GetSeries, request);
  if (!answer) return channels;
  for (const auto& column : answer->columns()) {
    if (column.name() != "time") channels.push_back({column.name(), column.unit()});
  }
  return channels;
}

std::optional<v1::Job> JobOf(const Settings& settings, const TypedWords& typed) {
  if (typed.positionals.empty()) return std::nullopt;
  v1::GetJobRequest request;
  request.set_name(JobName(typed.positionals.front()));
  return Ask(settings, &Client::Stub::GetJob, request);
}

Candidates Artifacts(const Settings& settings, const TypedWords& typed) {
  Candidates artifacts;
  const auto job = JobOf(settings, typed);
  if (!job) return artifacts;
  for (const v1::Artifact& artifact : job->artifacts()) artifacts.push_back({artifact.name(), ""});
  return artifacts;
}

Candidates Metrics(const Settings& settings, const TypedWords& typed) {
  Candidates metrics;
  const auto job = JobOf(settings, typed);
  if (!job) return metrics;
  for (const std::string& metric : job->sweep().metrics()) metrics.push_back({metric, ""});
  return metrics;
}

Candidates TemplateNames(const Settings&, const TypedWords&) {
  Candidates names;
  for (const Template& scenario : Templates()) names.push_back({std::string(scenario.name), ""});
  return names;
}

Candidates Laws(const Settings&, const TypedWords&) {
  Candidates laws;
  for (const LawEntry& law : LawCatalogue()) {
    std::string name(law.name);
    std::ranges::transform(name, name.begin(), [](unsigned char c) {
      return c == '_' ? '-' : static_cast<char>(std::tolower(c));
    });
    laws.push_back({name, std::string(law.source)});
  }
  return laws;
}

Candidates States(const Settings&, const TypedWords&) {
  Candidates states;
  const auto& type = *v1::Job::State_descriptor();
  for (int i = 1; i < type.value_count(); ++i) states.push_back({type.value(i)->name(), ""});
  return states;
}

Candidates EventKinds(const Settings&, const TypedWords&) {
  Candidates kinds;
  const auto& payload = *v1::Event::descriptor()->FindOneofByName("payload");
  for (int i = 0; i < payload.field_count(); ++i) kinds.push_back({payload.field(i)->name(), ""});
  return kinds;
}

Candidates Items(const Settings&, const TypedWords&) {
  Candidates items = {{"all", ""}};
  for (const std::string& item : PaperItems()) items.push_back({item, ""});
  return items;
}

const CLI::App& RootOf(const TypedWords& typed) {
  const CLI::App* root = typed.command;
  while (root->get_parent() != nullptr) root = root->get_parent();
  return *root;
}

// What `help` takes.
Candidates Commands(const Settings&, const TypedWords& typed) {
  Candidates commands = {{"tutorial", "the way through all of them"}};
  for (const CLI::App* command : RootOf(typed).get_subcommands({})) {
    commands.push_back({command->get_name(), command->get_description()});
  }
  return commands;
}

Candidates ConfigKeyNames(const Settings&, const TypedWords& typed) {
  Candidates keys;
  for (const std::string& key : ConfigKeys(RootOf(typed))) keys.push_back({key, VariableOf(key)});
  return keys;
}

// Profiles are sections of files, whatever else these hold.
Candidates ProfileNames(const Settings& settings, const TypedWords& typed) {
  std::vector<std::string> keys;
  for (const Candidate& key : ConfigKeyNames(settings, typed)) keys.push_back(key.text);
  Candidates profiles;
  for (const ConfigFile& file : ReadConfigFiles({keys.begin(), keys.end()})) {
    for (const auto& [name, section] : file.profiles) profiles.push_back({name, file.path});
  }
  return profiles;
}

}  // namespace

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
    for (const std::string& value : field.words) assignments.push_back({path + "=" + value, ""});
  }
  return assignments;
}

Candidates Values(const CommandLine& line, const CLI::Option& option, const TypedWords& typed) {
  using Source = Candidates (*)(const Settings&, const TypedWords&);
  static const std::map<ValueKind, Source> kSources = {{ValueKind::kJob, Jobs},
                                                       {ValueKind::kChannel, Channels},
                                                       {ValueKind::kArtifact, Artifacts},
                                                       {ValueKind::kMetric, Metrics},
                                                       {ValueKind::kState, States},
                                                       {ValueKind::kEventKind, EventKinds},
                                                       {ValueKind::kTemplate, TemplateNames},
                                                       {ValueKind::kLaw, Laws},
                                                       {ValueKind::kPaperItem, Items},
                                                       {ValueKind::kConfigKey, ConfigKeyNames},
                                                       {ValueKind::kProfile, ProfileNames},
                                                       {ValueKind::kCommand, Commands}};
  const auto source = kSources.find(line.KindOf(option));
  return source == kSources.end() ? Words(line, option) : source->second(line.settings(), typed);
}

}  // namespace contact::cli
