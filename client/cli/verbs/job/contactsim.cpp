#include "cli/verbs/job/contactsim.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/file_descriptor.h"
#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "cli/base/process.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

// Debian's Python first, for which the package of Debian is.
constexpr const char* kPythons[] = {"/usr/bin/python3", "python3"};
constexpr char kIsThere[] =
    "import importlib.util as u, sys; sys.exit(not all(map(u.find_spec, ('contactsim', 'grpc'))))";
constexpr char kVersions[] =
    "import contactsim as c, matplotlib as m; "
    "print(f'contactsim {c.__version__}, matplotlib {m.__version__}', end='')";

void Set(const char* variable, const std::string& value) {
  setenv(variable, value.c_str(), 1);  // No other thread reads the environment.
}

// Where the package of an archive or of a build is, which is not installed; empty without one.
fs::path PackageBeside() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* beside : {"../python", "../../python"}) {
    const fs::path found = folder / beside;
    if (fs::exists(found / "contactsim", error)) return fs::weakly_canonical(found);
  }
  return {};
}

void SetPath() {
  const fs::path package = PackageBeside();
  if (package.empty()) return;
  const char* path = std::getenv("PYTHONPATH");
  Set("PYTHONPATH", package.string() + (path ? fmt::format(":{}", path) : ""));
}

void SetConnection(const Settings& settings) {
  Set("CONTACT_SERVER", settings.server);
  Set("CONTACT_TLS_CA", settings.tls_ca);
  Set("CONTACT_CERT", settings.cert);
  Set("CONTACT_KEY", settings.key);
  Set("CONTACT_TOKEN_FILE", settings.token_file);
}

// What the first Python prints in which this ends well; none if it does in no Python.
std::optional<std::string> Ask(const char* what, std::string* python = nullptr) {
  for (const char* each : kPythons) {
    auto said = OutputOf({each, "-c", what}, {.silent_errors = true});
    if (said && python != nullptr) *python = each;
    if (said) return said;
  }
  return std::nullopt;
}

std::string FindPython() {
  SetPath();
  std::string python;
  if (Ask(kIsThere, &python)) return python;
  throw Failure(ExitCode::kLocal, "for drawing: " + InstallDrawing());
}

// Without byte code, which in a source tree would lie beside the sources.
std::vector<std::string> Command(const std::vector<std::string>& words, const Settings& settings) {
  SetConnection(settings);
  std::vector<std::string> command = {
      FindPython(), "-B", "-m", "contactsim",
      fmt::format("--timeout={}", static_cast<double>(settings.CallTimeout().count()) / 1e3)};
  command.insert(command.end(), words.begin(), words.end());
  return command;
}

OutputFormat FigureFormat(const std::string& file, const Settings& settings) {
  if (settings.output == OutputFormat::kTable) return FormatOfFigure(file);
  settings.RequireUse(kFigure);
  return settings.output;
}

// The width of a txt figure on the terminal of the standard output.
int ColumnsOf(const Settings& settings) {
  constexpr int kLeast = 40;
  constexpr int kUsual = 80;
  const int width = settings.OutputStyle().width;
  return width > 0 ? std::max(width, kLeast) : kUsual;
}

}  // namespace

std::string ContactsimVersion() {
  SetPath();
  return Ask(kVersions).value_or("");
}

std::string InstallDrawing() {
  return fmt::format("apt-get install {} python3-matplotlib",
                     PackageBeside().empty() ? "python3-contactsim"
                                             : "python3-grpcio python3-pandas python3-yaml");
}

void BecomeContactsim(const std::vector<std::string>& words, const Settings& settings) {
  const std::vector<std::string> command = Command(words, settings);
  std::fflush(nullptr);
  BecomeProcess(command);
}

void RunContactsim(const std::vector<std::string>& words, const Settings& settings,
                   const std::string& input) {
  const ScratchFolder scratch;
  const std::string path = scratch.path() / "input";
  WriteText(input, path);
  const FileDescriptor read_end(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::fflush(nullptr);
  const int code =
      WaitForProcess(StartProcess(Command(words, settings), {.input = read_end.get()}));
  if (code != 0) throw Failure(static_cast<ExitCode>(code), "nothing is drawn");
}

OutputFormat FormatOfFigure(const std::string& path) {
  return RequireFormatOfFile(path, kFigure, OutputFormat::kSvg);
}

std::vector<std::string> FigureWords(const std::string& file, const std::string& name,
                                     const Settings& settings) {
  const OutputFormat format = FigureFormat(file, settings);
  std::vector<std::string> words = {fmt::format("--format={}", NameOf(format)),
                                    fmt::format("--columns={}", ColumnsOf(settings))};
  if (!file.empty()) RequireWritable(file);
  if (!file.empty() || format != OutputFormat::kText) {
    const std::string path = file.empty() ? name + std::string(InfoOf(format).ending) : file;
    words.push_back("--file=" + path);
  }
  return words;
}

}  // namespace contact::cli
