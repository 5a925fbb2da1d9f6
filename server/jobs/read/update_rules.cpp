#include "jobs/read/update_rules.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "base/spelling.h"
#include "jobs/read/label_rules.h"
#include "wire/rules/rules.h"

namespace contact {
namespace {

void CheckNote(const std::string& note, std::vector<Violation>* violations) {
  const Rules rules(violations);
  rules.RequireShort("note", note, RuleOf<v1::Job>(v1::Job::kNoteFieldNumber).max_characters());
  std::string line = note;
  std::erase(line, '\n');
  rules.RequirePrintable("note", line);
}

// Which of the fields that a call can change it is to change.
struct Mask {
  bool labels = false;
  bool note = false;
};

Mask ReadMask(const v1::UpdateJobRequest& request, std::vector<Violation>* violations) {
  if (request.update_mask().paths().empty()) {
    const Mask filled{!request.job().labels().empty(), !request.job().note().empty()};
    if (filled.labels || filled.note) return filled;
    violations->push_back({"update_mask", "names nothing to change", "name labels, note or both"});
    return filled;
  }
  Mask mask;
  for (const std::string& path : request.update_mask().paths()) {
    mask.labels |= path == "labels" || path == "*";
    mask.note |= path == "note" || path == "*";
    if (path == "labels" || path == "note" || path == "*") continue;
    violations->push_back({"update_mask",
                           fmt::format("names {}, which cannot be changed", Quoted(path)),
                           DidYouMean(path, {"labels", "note"}, "name labels, note or both")});
    break;  // There may be millions.
  }
  return mask;
}

}  // namespace

Result<JobRemark> ToRemark(const v1::UpdateJobRequest& request) {
  const v1::Job& job = request.job();
  std::vector<Violation> violations;
  const Mask mask = ReadMask(request, &violations);
  JobRemark remark{.name = job.name(), .expected_uid = request.expected_uid()};
  if (mask.labels) {
    CheckLabels(job.labels(), &violations);
    remark.labels.emplace(job.labels().begin(), job.labels().end());
  }
  if (mask.note) {
    CheckNote(job.note(), &violations);
    remark.note = job.note();
  }
  if (!violations.empty()) return Invalid(std::move(violations));
  return remark;
}

}  // namespace contact
