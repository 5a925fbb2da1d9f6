#pragma once

#include <string>
#include <vector>

#include "cli/export/provenance.h"
#include "cli/export/series_selection.h"

namespace contact::cli {

/// How many cycles of a job within the time range of `part` have too few of all recorded samples,
/// in the words of the stamp of figures: `7002 of 7003 contacts have fewer than 10 samples`. Empty
/// if all have enough. One that the end of the run cuts may have any number.
std::string SamplingNote(const v1::Job& job, const std::vector<double>& time,
                         const SeriesSelection& part);

/// The same for a job of the server; empty while it goes on. Asks for its ledger and the times of
/// all samples. Throws CallFailure, and Failure as ReadRecording does.
std::string SamplingNote(Client& client, const std::string& job, const SeriesSelection& part,
                         const Settings& settings);

/// The source of a file with the note as its `sampling`, unless it is empty.
Provenance WithSampling(Provenance source, const std::string& note);

/// Tells on the standard error a note that is not empty, and the command that records more.
void TellSampling(const std::string& note, const std::string& job);

}  // namespace contact::cli
