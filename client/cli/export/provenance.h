#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// Names and values, in the order in which they are shown.
using Provenance = std::vector<std::pair<std::string, std::string>>;

/// What makes a result repeatable: title, job, scenario as JSON, its SHA-256, the server's version
/// and revision, the solver's options with every default spelt out, convergence.
Provenance ProvenanceOf(const v1::Job& job);

/// The part of ProvenanceOf that comments of CSV have: title, job, SHA-256, version, revision.
Provenance SourceOf(const v1::Job& job);

/// Each entry as a line `# name: value`.
std::string CommentLines(const Provenance& source);

/// The solver's options of a scenario that keeps the rules, every default spelt out.
v1::Solver SolverInFull(const v1::Scenario& scenario);

/// Two BibTeX entries: the paper whose method the server computes with, and the run or sweep `job`,
/// with its year, the version and revision of the contactd that computed it, and the SHA-256 of its
/// scenario.
std::string BibTeX(const v1::Job& job);

}  // namespace contact::cli
