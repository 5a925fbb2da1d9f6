#pragma once

#include <string>

namespace contact::cli {

/// Puts title and subject into a PDF, in the place of the time at which it was made. Throws Failure
/// (kLocal) if it is none.
void DescribePdf(const std::string& title, const std::string& subject, std::string* picture);

}  // namespace contact::cli
