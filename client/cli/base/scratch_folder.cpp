#include "cli/base/scratch_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "cli/base/failure.h"

namespace contact::cli {

namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "contactctl-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw Failure(ExitCode::kLocal, "cannot make " + name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace contact::cli
