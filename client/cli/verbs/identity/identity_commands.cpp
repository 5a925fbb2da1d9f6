#include "cli/verbs/identity/identity_commands.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/file_descriptor.h"
#include "base/spelling.h"
#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "cli/base/message.h"
#include "cli/base/number.h"
#include "cli/base/table.h"
#include "cli/settings/options.h"
#include "cli/text/print_job.h"
#include "identity/audit_chain.h"
#include "identity/secret_file.h"
#include "identity/token_table.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::system_clock;

// What the commands about tokens ask.
struct TokenOptions {
  std::string file;
  std::string name;
  std::string tenant;
  std::vector<std::string> roles;
  std::string ttl = "90d";
  std::string id;
  /// Where a new token is written; empty: the standard output.
  std::string to;
};

std::vector<TokenRecord> ReadTokens(const std::string& file) {
  if (!fs::exists(file)) return {};
  std::string text, mistake;
  if (!ReadSecretFile(file, &text, &mistake)) throw Failure(ExitCode::kLocal, mistake);
  const auto table = TokenTable::Parse(text);
  if (const auto* wrong = std::get_if<std::string>(&table)) {
    throw Failure(ExitCode::kLocal, fmt::format("{}: {}", file, *wrong));
  }
  return std::get<TokenTable>(table).records();
}

// Changes the file while nobody else does.
template <class Change>
void ChangeTokens(const std::string& file, Change change) {
  const fs::path folder = fs::path(file).has_parent_path() ? fs::path(file).parent_path() : ".";
  const FileDescriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.valid()) ::flock(lock.get(), LOCK_EX);
  std::vector<TokenRecord> records = ReadTokens(file);
  change(&records);
  ReplaceText(TokenTable::Format(records), file, kOwnerOnly);
}

Principal PrincipalOf(const TokenOptions& options) {
  std::string mistake;
  const std::string tenant = options.tenant.empty() ? "" : "tenant:" + options.tenant;
  const auto principal = ParsePrincipal(
      fmt::format("user:{} {} roles:{}", options.name, tenant, fmt::join(options.roles, ",")),
      &mistake);
  if (!principal) throw Failure(ExitCode::kUsage, mistake);
  return *principal;
}

ExitCode CreateToken(const TokenOptions& options, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  const auto expires =
      std::chrono::floor<std::chrono::seconds>(system_clock::now() + RequireDuration(options.ttl));
  const NewToken made = MakeToken(PrincipalOf(options), expires);
  if (!options.to.empty()) ReplaceText(made.token + "\n", options.to, kOwnerOnly);
  ChangeTokens(options.file, [&made](auto* records) { records->push_back(made.record); });
  if (options.to.empty()) fmt::print("{}\n", made.token);
  Tell("token {} of {} until {}; {}\n", made.record.id, options.name, FormatUtc(expires),
       options.to.empty() ? "it is shown this once" : "it is in " + options.to);
  return ExitCode::kOk;
}

ExitCode RevokeToken(const TokenOptions& options, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  ChangeTokens(options.file, [&options](auto* records) {
    const auto found = std::ranges::find(*records, options.id, &TokenRecord::id);
    if (found == records->end()) {
      throw Failure(ExitCode::kNotFound,
                    fmt::format("{} has no token {}", options.file, options.id));
    }
    found->revoked = true;
  });
  fmt::print("{} revoked\n", options.id);
  return ExitCode::kOk;
}

ExitCode ListTokens(const TokenOptions& options, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable, OutputFormat::kJson});
  Table table({{"ID"}, {"USER"}, {"TENANT"}, {"ROLES"}, {"EXPIRES"}, {"STATE"}});
  auto json = nlohmann::ordered_json::array();
  for (const TokenRecord& record : ReadTokens(options.file)) {
    const bool expired = record.expires <= system_clock::now();
    const std::string state = record.revoked ? "revoked" : expired ? "expired" : "valid";
    std::vector<std::string> roles;
    for (const Role role : record.principal.roles) roles.emplace_back(NameOf(role));
    json.push_back({{"id", record.id},
                    {"user", record.principal.name},
                    {"tenant", record.principal.tenant},
                    {"roles", roles},
                    {"expires", FormatUtc(record.expires)},
                    {"state", state}});
    table.Add({record.id, record.principal.name, record.principal.tenant,
               fmt::format("{}", fmt::join(roles, ",")), FormatUtc(record.expires), state});
  }
  if (settings.output == OutputFormat::kJson) {
    PrintJson(json.dump(2) + "\n", settings);
  } else {
    fmt::print("{}", table.Text(settings.OutputStyle()));
  }
  return ExitCode::kOk;
}

// What the command about an audit log asks.
struct AuditOptions {
  std::string file;
  std::string head;
  std::string key;
};

ExitCode CheckAudit(const AuditOptions& options, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  const auto& [file, head, key_file] = options;
  std::string key, mistake;
  if (!key_file.empty() && !ReadAuditKey(key_file, &key, &mistake)) {
    throw Failure(ExitCode::kLocal, mistake);
  }
  const std::string last = head.empty() ? "" : ReadHead(head);
  if (!head.empty() && last.empty()) throw Failure(ExitCode::kLocal, "cannot read " + head);
  const auto findings = VerifyAudit(file, last, key);
  if (!findings) throw Failure(ExitCode::kLocal, "cannot read " + file);
  if (findings->bad_line > 0) {
    throw Failure(ExitCode::kRunFailed,
                  fmt::format("{}:{}: does not fit: {}", findings->bad_file.string(),
                              findings->bad_line, findings->mistake));
  }
  if (!head.empty() && !findings->has_head) {
    throw Failure(ExitCode::kRunFailed,
                  file +
                      ": the line that the server has written last is not there: lines are cut "
                      "off, or all were made anew");
  }
  if (findings->missing > 0) {
    fmt::print(stderr, "{}.1 to {}.{} are not here\n", file, file, findings->missing);
  }
  const std::string where = findings->files > 1 ? fmt::format(" in {} files", findings->files) : "";
  fmt::print("{}  {}{}, unbroken; the last is {}\n", file, Count(findings->lines, "line", "lines"),
             where, findings->last);
  return ExitCode::kOk;
}

void AddTokenFile(CommandLine& line, CLI::App& command, TokenOptions* options) {
  AddOption(line, command, "--tokens", &options->file, ValueKind::kFile,
            "The file that --tokens of the server names")
      ->required();
}

}  // namespace

void AddToken(CommandLine& line, CLI::App& server) {
  CLI::App* token = server.add_subcommand(
      "token", "Make, list and revoke tokens in the file of a server, on its machine");
  token->require_subcommand(1);
  auto options = std::make_shared<TokenOptions>();
  CLI::App* create = token->add_subcommand("create", "Make a token and show it, this once");
  AddTokenFile(line, *create, options.get());
  create->add_option("--name", options->name, "Whose it is; jobs have this owner")->required();
  create->add_option("--tenant", options->tenant, "Whose jobs it sees; none with the role server");
  line.SetWords(create->add_option("--role", options->roles, "What it may do"),
                {"read", "submit", "operator", "admin", "server"})
      ->required();
  AddOption(line, *create, "-f,--file", &options->to, ValueKind::kFile,
            "Write the token there, for its owner alone, instead of showing it");
  create->add_option("--ttl", options->ttl, "How long it is valid")
      ->type_name("TIME")
      ->capture_default_str();
  line.SetAction(*create, options, CreateToken);
  CLI::App* list = token->add_subcommand("list", "List tokens, without their secrets");
  AddTokenFile(line, *list, options.get());
  line.SetAction(*list, options, ListTokens);
  CLI::App* revoke = token->add_subcommand("revoke", "Make a token invalid, a second later");
  AddTokenFile(line, *revoke, options.get());
  revoke->add_option("ID", options->id, "The id that list shows")->required();
  line.SetAction(*revoke, options, RevokeToken);
}

void AddAudit(CommandLine& line, CLI::App& server) {
  CLI::App* audit = server.add_subcommand("audit", "Look at the audit log of a server");
  audit->require_subcommand(1);
  CLI::App* verify =
      audit->add_subcommand("verify", "Check that no line was changed, left out or put in");
  auto options = std::make_shared<AuditOptions>();
  AddOption(line, *verify, "FILE", &options->file, ValueKind::kFile,
            "The file that --audit-log of the server names")
      ->required();
  AddOption(
      line, *verify, "--head", &options->head, ValueKind::kFile,
      "The file audit-head of --data-dir of the server: shows whether lines are cut off at the "
      "end, or all were made anew");
  AddOption(line, *verify, "--key", &options->key, ValueKind::kFile,
            "The file that --audit-key of the server names");
  line.SetAction(*verify, options, CheckAudit);
}

}  // namespace contact::cli
