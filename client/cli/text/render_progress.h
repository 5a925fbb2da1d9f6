#pragma once

#include <optional>
#include <string>

#include "contact/v1/job.pb.h"

namespace contact::cli {

/// The part of a run or sweep that is done, from 0 to 1; 0 while its length is unknown.
double PartDone(const v1::Progress& progress);

/// The time [s] that a job will still take at its speed so far; none while too little is done to
/// tell.
std::optional<double> TimeToGo(double part_done, double elapsed_s);

/// TimeToGo in words, such as `, 3.2 s left`; empty for none.
std::string TimeLeft(double part_done, double elapsed_s);

/// How far a run is, how long it will still take, and what keeps it busy, in words.
std::string ProgressWords(const v1::Progress& progress, double elapsed_s);

/// A bar with ProgressWords behind it, in at most `width` characters (0: no limit); the words alone
/// where both do not fit. Without `utf8` the bar is of ASCII characters.
std::string RenderProgress(const v1::Progress& progress, double elapsed_s, int width,
                           bool utf8 = true);

}  // namespace contact::cli
