#pragma once

#include <string>

#include "cli/figures/figure.h"
#include "cli/settings/settings.h"

namespace contact::cli {

/// The format of a picture: as -o says, or as the file is called. Throws Failure (kUsage) if -o
/// says none.
std::string PictureFormat(const std::string& file, const Settings& settings);

/// The file of a picture: as it is called, or after the name of what is drawn.
std::string PicturePath(const std::string& file, const std::string& name, const Settings& settings);

/// Draws a figure to its file and tells it; txt without a file is printed, as wide as the terminal.
/// Throws as Draw does.
void WritePicture(const Figure& figure, const std::string& name, const std::string& file,
                  const Settings& settings);

}  // namespace contact::cli
