#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <system_error>

#include "cli/commands.h"
#include "cli/number.h"
#include "cli/paper/items.h"

namespace contact::cli {
namespace {

struct PaperArguments {
  std::vector<std::string> items;
  std::string directory = "paper";
};

std::vector<std::string> Chosen(const std::vector<std::string>& asked) {
  const std::vector<std::string>& all = PaperItems();
  if (asked.empty() || std::find(asked.begin(), asked.end(), "all") != asked.end()) return all;
  for (const std::string& id : asked) {
    if (std::find(all.begin(), all.end(), id) == all.end()) {
      throw Failure(ExitCode::kUsage,
                    fmt::format("unknown item '{}' — one of {} or all", id, fmt::join(all, ", ")));
    }
  }
  return asked;
}

ExitCode Paper(const PaperArguments& arguments, const Settings& settings) {
  settings.RequireOutput({"table"});
  const std::vector<std::string> chosen = Chosen(arguments.items);
  const auto start = std::chrono::steady_clock::now();
  std::error_code error;
  std::filesystem::create_directories(arguments.directory, error);
  if (error) {
    throw Failure(ExitCode::kLocal,
                  fmt::format("cannot make {}: {}", arguments.directory, error.message()));
  }
  Client client = settings.Connect();
  Lab lab(client, settings);
  const std::vector<PaperItem> items = MakePaperItems(chosen, lab);
  for (const PaperItem& item : items) Write(item, arguments.directory);
  fmt::print("{}", Summary(items, settings.OutputStyle()));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  fmt::print(stderr, "{} in {}, in {}\n",
             Count(static_cast<std::int64_t>(items.size()), "item", "items"), arguments.directory,
             Seconds(took.count()));
  const bool holds =
      std::all_of(items.begin(), items.end(), [](const PaperItem& item) { return item.holds(); });
  return holds ? ExitCode::kOk : ExitCode::kDiffers;
}

}  // namespace

void AddPaperCommand(CLI::App& app, const Settings& settings, Action* action) {
  CLI::App* paper = app.add_subcommand(
      "paper", "Make the paper's figures and tables again, each number beside the published one");
  auto arguments = std::make_shared<PaperArguments>();
  paper->add_option("ITEM", arguments->items,
                    fmt::format("{}, or all (default)", fmt::join(PaperItems(), " ")));
  paper->add_option("-o,--directory", arguments->directory, "Where to write data and tables")
      ->type_name("DIR")
      ->capture_default_str();
  paper->callback([arguments, &settings, action] {
    *action = [arguments, &settings] { return Paper(*arguments, settings); };
  });
}

}  // namespace contact::cli
