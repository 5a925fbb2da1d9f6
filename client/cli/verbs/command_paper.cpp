#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <system_error>

#include "base/spelling.h"
#include "cli/base/message.h"
#include "cli/base/number.h"
#include "cli/base/text_file.h"
#include "cli/export/provenance.h"
#include "cli/figures/draw.h"
#include "cli/link/connect.h"
#include "cli/paper/cases.h"
#include "cli/paper/index.h"
#include "cli/paper/items.h"
#include "cli/text/render_json.h"
#include "cli/verbs/job/options.h"
#include "cli/verbs/verbs.h"

namespace contact::cli {
namespace {

namespace fs = std::filesystem;

struct PaperArguments {
  std::vector<std::string> items;
  std::string directory = "paper";
  std::string format;  // Empty: svg if gnuplot is there.
};

std::vector<std::string> Chosen(const std::vector<std::string>& asked) {
  const std::vector<std::string>& all = PaperItems();
  if (asked.empty() || std::ranges::find(asked, "all") != asked.end()) return all;
  for (const std::string& id : asked) {
    if (std::ranges::find(all, id) == all.end()) {
      throw Failure(ExitCode::kUsage,
                    fmt::format("unknown item '{}' — one of {} or all", id, fmt::join(all, ", ")));
    }
  }
  return asked;
}

// Draws the figures beside their data. Returns them as SVG, by item, for the page. Without --format
// a failure to draw is only told.
std::map<std::string, std::string> DrawAll(const std::vector<PaperItem>& items,
                                           const PaperArguments& arguments) {
  const OutputFormat format = FindFormat(arguments.format).value_or(OutputFormat::kSvg);
  std::map<std::string, std::string> inlined;
  try {
    for (const PaperItem& item : items) {
      if (!item.figure) continue;
      const std::string path =
          fs::path(arguments.directory) / (item.id + std::string(InfoOf(format).ending));
      Draw(*item.figure, format, path);
      inlined[item.id] =
          format == OutputFormat::kSvg ? InlineSvg(ReadText(path)) : DrawInline(*item.figure);
    }
  } catch (const Failure& failure) {
    if (!arguments.format.empty()) throw;
    Tell("figures are not drawn: {}\n", failure.what());
  }
  return inlined;
}

Origin OriginOf(const v1::ServerInfo& info, const PaperArguments& arguments) {
  const std::string items =
      arguments.items.empty() ? "all" : fmt::format("{}", fmt::join(arguments.items, " "));
  return {.server = info.revision().empty()
                        ? fmt::format("contactd {}", info.version())
                        : fmt::format("contactd {} ({})", info.version(), info.revision()),
          .solver = ToJsonLine(SolverInFull(TripleChain(0.8, 0.7))),
          .command = fmt::format("contactctl paper {} -d {}", items, arguments.directory)};
}

void MakeFolder(const std::string& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error) {
    throw Failure(ExitCode::kLocal, fmt::format("cannot make {}: {}", directory, error.message()));
  }
}

// Writes the data of the items. A figure of no single run names this server as its source.
void WriteAll(const v1::ServerInfo& server, const PaperArguments& arguments,
              std::vector<PaperItem>* items) {
  const Provenance here = {{"version", server.version()}, {"revision", server.revision()}};
  for (PaperItem& item : *items) {
    if (item.figure && item.figure->sources.empty()) item.figure->sources = {here};
    Write(item, arguments.directory);
  }
}

ExitCode Paper(const PaperArguments& arguments, const Settings& settings) {
  settings.RequireOutput({OutputFormat::kTable});
  const std::vector<std::string> chosen = Chosen(arguments.items);
  const auto start = std::chrono::steady_clock::now();
  MakeFolder(arguments.directory);
  Client client = Connect(settings);
  ServerLab lab(client, settings);
  std::vector<PaperItem> items = MakePaperItems(chosen, lab);
  const v1::ServerInfo server =
      client.Call(&Client::Stub::GetServerInfo, v1::GetServerInfoRequest());
  WriteAll(server, arguments, &items);
  const std::map<std::string, std::string> figures = DrawAll(items, arguments);
  WriteText(IndexPage(items, figures, OriginOf(server, arguments)),
            fs::path(arguments.directory) / "index.html");
  fmt::print("{}", Summary(items, settings.OutputStyle()));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  Tell("{}, {} drawn, index.html in {}, in {}\n",
       Count(static_cast<std::int64_t>(items.size()), "item", "items"), figures.size(),
       arguments.directory, Seconds(took.count()));
  return std::ranges::all_of(items, &PaperItem::holds) ? ExitCode::kOk : ExitCode::kDiffers;
}

}  // namespace

void AddPaper(CommandLine& line, CLI::App& paper) {
  auto arguments = std::make_shared<PaperArguments>();
  AddOption(line, paper, "ITEM", &arguments->items, ValueKind::kPaperItem,
            fmt::format("{}, or all (default)", fmt::join(PaperItems(), " ")));
  CLI::Option* directory = AddDestination(line, paper, "-d,--directory", &arguments->directory,
                                          "Where to write data, tables, figures and index.html");
  line.SetKind(directory, ValueKind::kDirectory)->capture_default_str();
  AddOption(line, paper, "--format", &arguments->format, {"svg", "png", "pdf", "tikz"},
            "How to draw the figures. Default: svg, if gnuplot is there")
      ->type_name("FORMAT");
  line.SetAction(paper, arguments, Paper);
}

}  // namespace contact::cli
