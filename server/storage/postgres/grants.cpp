#include "storage/postgres/grants.h"

#include <absl/strings/str_cat.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_replace.h>

#include <vector>

namespace contact::postgres {
namespace {

// Functions that write, of both roles and of one.
const std::vector<std::string>& Shared() {
  static const std::vector<std::string> names = {"change_job", "request_cancel", "purge"};
  return names;
}
const std::vector<std::string>& OfFront() {
  static const std::vector<std::string> names = {"create_job", "remove_job", "compact_job"};
  return names;
}
const std::vector<std::string>& OfWorker() {
  static const std::vector<std::string> names = {
      "beat", "claim", "leave", "lend", "take_loan", "return_loan", "refuse_loan", "settle_loans"};
  return names;
}

// Functions that only read run with the rights of whoever calls them.
constexpr char kReaders[] =
    "contactd.read_job, contactd.read_events, contactd.count_of, contactd.demand,"
    " contactd.moved_since";

std::string Names(const std::vector<std::string>& names) {
  return absl::StrJoin(names, ", ", [](std::string* out, const std::string& name) {
    absl::StrAppend(out, "contactd.", name);
  });
}

// A name as SQL has it.
std::string Quoted(const std::string& name) {
  return absl::StrCat("\"", absl::StrReplaceAll(name, {{"\"", "\"\""}}), "\"");
}

std::string AsOwner(const std::vector<std::string>& names) {
  std::string script;
  for (const std::string& name : names) {
    absl::StrAppend(&script, "ALTER FUNCTION contactd.", name,
                    " SECURITY DEFINER SET search_path = contactd, pg_temp;");
  }
  return script;
}

std::string GrantTo(const std::string& role, const std::vector<std::string>& functions) {
  if (role.empty()) return "";
  const std::string to = absl::StrCat(" TO ", Quoted(role), ";");
  return absl::StrCat("GRANT USAGE ON SCHEMA contactd", to,
                      "GRANT SELECT ON ALL TABLES IN SCHEMA contactd", to,
                      "GRANT EXECUTE ON FUNCTION ", kReaders, to, "GRANT EXECUTE ON FUNCTION ",
                      Names(Shared()), to, "GRANT EXECUTE ON FUNCTION ", Names(functions), to);
}

}  // namespace

std::string GrantScript(const Grants& grants) {
  if (grants.front.empty() && grants.worker.empty()) return "";
  return absl::StrCat("REVOKE ALL ON ALL FUNCTIONS IN SCHEMA contactd FROM PUBLIC;",
                      AsOwner(Shared()), AsOwner(OfFront()), AsOwner(OfWorker()),
                      GrantTo(grants.front, OfFront()), GrantTo(grants.worker, OfWorker()));
}

}  // namespace contact::postgres
