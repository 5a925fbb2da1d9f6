#pragma once

#include <string>

#include "cli/base/style.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// A job for people: state, labels and note, ledger, final bodies, balances, warnings.
/// `style.columns` selects columns of the ledger; the table of bodies always has all.
std::string RenderJob(const v1::Job& job, const Style& style);

/// The title of a job, also of one from a server of an earlier version; empty if it has none.
const std::string& TitleOf(const v1::Job& job);

/// Its labels, `key=value, key=value`, in the order of their keys; empty if it has none.
std::string LabelsText(const v1::Job& job);

/// A state in its colour, and in parentheses the reason for it unless that is empty.
std::string StateText(v1::Job::State state, const std::string& reason, const Style& style);

/// `error: ` and why the job failed, as a line; empty for a job without an error.
std::string ErrorLine(const v1::Job& job, const Style& style);

/// The colour in which the state of a job is shown.
Tone ToneOf(v1::Job::State state);

}  // namespace contact::cli
