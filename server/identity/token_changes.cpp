#include "identity/token_changes.h"

#include <algorithm>
#include <utility>

#include "base/ids.h"

namespace contact {
namespace {

const TokenRecord* Find(const TokenTable& table, const std::string& id) {
  const auto found = std::ranges::find(table.records(), id, &TokenRecord::id);
  return found == table.records().end() ? nullptr : &*found;
}

// What has become of a token; empty: nothing. `old`, if any, and `now` are its records.
std::string ChangeOf(const TokenRecord* old, const TokenRecord& now,
                     std::chrono::system_clock::time_point time) {
  if (old == nullptr) return now.revoked || now.expires <= time ? "" : "CREATED";
  if (now.revoked) return old->revoked ? "" : "REVOKED";
  const bool same = !old->revoked && old->sha256 == now.sha256 && old->expires == now.expires &&
                    old->principal == now.principal;
  return same ? "" : "CHANGED";
}

}  // namespace

std::vector<AuditRecord> TokenChanges(const TokenTable* before, const TokenTable& now,
                                      const std::string& file,
                                      std::chrono::system_clock::time_point time) {
  std::vector<AuditRecord> records;
  const auto add = [&](const TokenRecord& token, std::string code) {
    if (code.empty()) return;
    records.push_back({.time = time,
                       .call = RandomIds().NextId(),
                       .caller = token.principal,
                       .peer = "file:" + file,
                       .method = "token",
                       .job = {},
                       .code = std::move(code),
                       .reason = {}});
  };
  for (const TokenRecord& token : now.records()) {
    const std::string change =
        ChangeOf(before == nullptr ? nullptr : Find(*before, token.id), token, time);
    add(token, before == nullptr && !change.empty() ? "VALID" : change);
  }
  if (before == nullptr) return records;
  for (const TokenRecord& token : before->records()) {
    if (!token.revoked && Find(now, token.id) == nullptr) add(token, "REMOVED");
  }
  return records;
}

}  // namespace contact
