#include "storage/postgres/grants.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_replace.h>
#include <absl/types/span.h>

#include <array>
#include <initializer_list>

namespace contact::postgres {
namespace {

using Functions = absl::Span<const char* const>;

// Of fronts and workers.
constexpr std::array kShared = {"schema_version", "read_job", "read_events", "positions_of",
                                "moved_since",    "count_of", "demand",      "change_job",
                                "request_cancel", "purge"};
constexpr std::array kOfFront = {"create_job", "remove_job", "compact_job", "owner_of",  "bytes_of",
                                 "list_jobs",  "job_sizes",  "keep",        "remark_job"};
constexpr std::array kOfWorker = {"beat",      "claim",       "leave",       "lend",
                                  "take_loan", "return_loan", "refuse_loan", "settle_loans"};
constexpr std::array kOfLauncher = {"demand"};

// Runs a command in which %I is the database.
std::string OnDatabase(const std::string& command) {
  return absl::StrCat("DO $do$BEGIN EXECUTE format('", absl::StrReplaceAll(command, {{"'", "''"}}),
                      "', current_database()); END$do$;");
}

// A name as SQL has it.
std::string Quoted(const std::string& name) {
  return absl::StrCat("\"", absl::StrReplaceAll(name, {{"\"", "\"\""}}), "\"");
}

// They have the rights of the owner, whoever calls them.
std::string AsOwner(Functions functions) {
  std::string script;
  for (const char* name : functions) {
    absl::StrAppend(&script, "ALTER FUNCTION contactd.", name,
                    " SECURITY DEFINER SET search_path = contactd, pg_temp;");
  }
  return script;
}

std::string GrantTo(const std::string& role, Functions functions) {
  const std::string names = absl::StrJoin(functions, ", contactd.");
  return absl::StrCat("GRANT EXECUTE ON FUNCTION contactd.", names, " TO ", role, ";");
}

// The role has the right to call these functions, whatever it had before.
std::string OnlyTo(const std::string& name, std::initializer_list<Functions> all) {
  if (name.empty()) return "";
  const std::string role = Quoted(name);
  std::string script = absl::StrCat("REVOKE ALL ON ALL TABLES IN SCHEMA contactd FROM ", role,
                                    "; REVOKE ALL ON ALL FUNCTIONS IN SCHEMA contactd FROM ", role,
                                    "; GRANT USAGE ON SCHEMA contactd TO ", role, ";",
                                    OnDatabase("GRANT CONNECT ON DATABASE %I TO " + role));
  for (const Functions functions : all) absl::StrAppend(&script, GrantTo(role, functions));
  return script;
}

}  // namespace

std::string GrantScript(const Grants& grants) {
  if (grants.front.empty() && grants.worker.empty() && grants.launcher.empty()) return "";
  return absl::StrCat(
      // Whoever may connect hears all notes and can send some.
      OnDatabase("REVOKE CONNECT ON DATABASE %I FROM PUBLIC"), AsOwner(kShared), AsOwner(kOfFront),
      AsOwner(kOfWorker), OnlyTo(grants.front, {kShared, kOfFront}),
      OnlyTo(grants.worker, {kShared, kOfWorker}), OnlyTo(grants.launcher, {kOfLauncher}));
}

}  // namespace contact::postgres
