#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/help/candidates.h"
#include "cli/settings/options.h"
#include "cli/verbs/job/contactsim.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

struct PaperArguments {
  std::vector<std::string> items;
  std::string directory = "paper";
  const CLI::App* command = nullptr;
};

void CheckItems(const std::vector<std::string>& asked) {
  const std::vector<std::string>& all = PaperItems();
  for (const std::string& id : asked) {
    if (id == "all" || std::ranges::find(all, id) != all.end()) continue;
    throw Failure(ExitCode::kUsage,
                  fmt::format("unknown item '{}' — one of {} or all", id, fmt::join(all, ", ")));
  }
}

void MakeFolder(const std::string& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) {
    throw Failure(ExitCode::kLocal, fmt::format("cannot make {}: {}", directory, error.message()));
  }
}

ExitCode Paper(const PaperArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  CheckItems(arguments.items);
  MakeFolder(arguments.directory);
  std::vector<std::string> words = {"paper", "--directory=" + arguments.directory};
  for (const std::string& flag : GivenFlags(*arguments.command, {"--format"})) {
    words.push_back(flag);
  }
  words.emplace_back("--");
  words.insert(words.end(), arguments.items.begin(), arguments.items.end());
  BecomeContactsim(words, settings);
}

}  // namespace

void AddPaper(CommandLine& line, CLI::App& paper) {
  auto arguments = std::make_shared<PaperArguments>();
  arguments->command = &paper;
  AddOption(line, paper, "ITEM", &arguments->items, ValueKind::kPaperItem,
            fmt::format("{}, or all (default)", fmt::join(PaperItems(), " ")));
  CLI::Option* directory = AddDestination(line, paper, "-d,--directory", &arguments->directory,
                                          "Where to write data, tables, figures and index.html");
  line.SetKind(directory, ValueKind::kDirectory)->capture_default_str();
  line.SetWords(paper.add_option("--format")
                    ->description("How to draw the figures. Default: svg, if matplotlib is there"),
                {"svg", "png", "pdf", "eps", "pgf"})
      ->type_name("FORMAT");
  line.SetAction(paper, arguments, Paper);
}

}  // namespace contact::cli
