#include "cli/help/manual.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>
#include <sstream>
#include <string_view>

#include "cli/base/failure.h"
#include "cli/base/files.h"
#include "cli/base/process.h"
#include "cli/help/contract/reference.h"

namespace contact::cli {
namespace {

// Text with the special characters of scdoc escaped; `code` becomes bold.
std::string Inline(std::string_view text) {
  constexpr std::string_view kAtBegin = "[]|#-.:";
  std::string escaped;
  for (const char c : text) {
    const bool special = c == '*' || c == '_' || c == '\\';
    const bool first = escaped.empty() && kAtBegin.find(c) != std::string_view::npos;
    if (special || first) escaped += '\\';
    escaped += c == '`' ? '*' : c;
  }
  return escaped;
}

std::string Block(const std::string& text) { return fmt::format("```\n{}\n```\n", text); }

std::string Paragraphs(const std::string& text) {
  std::istringstream lines(text);
  std::string page;
  std::string code;
  const auto end_code = [&] {
    if (!code.empty()) page += "\n\n" + Block(code.substr(0, code.size() - 1)) + "\n";
    code.clear();
  };
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with(" ")) {
      code += line + "\n";
      continue;
    }
    end_code();
    if (line.empty()) {
      page += "\n\n";
    } else {  // Joined, because a line could begin with a request of troff.
      page += (page.empty() || page.back() == '\n' ? "" : " ") + Inline(line);
    }
  }
  end_code();
  return page + "\n";
}

std::string Usage(const CLI::App& command, const std::string& name) {
  std::string usage = fmt::format("*{}* [options]", Inline(name));
  if (!command.get_subcommands({}).empty()) usage += " COMMAND";
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const bool many = option->get_items_expected_max() > 1;
    const std::string word = fmt::format("_{}_{}", Inline(option->get_name()), many ? "..." : "");
    usage += option->get_required() ? " " + word : " [" + word + "]";
  }
  return usage;
}

std::string OptionText(const CommandLine& line, const CLI::Option& option) {
  std::string type = option.get_type_name();
  type = type.substr(0, type.find(':'));
  std::string text = fmt::format(
      "*{}*", Inline(option.get_positional() ? option.get_name() : option.get_name(false, true)));
  if (!option.get_positional() && option.get_items_expected_max() > 0 && !type.empty()) {
    text += " " + Inline(type);
  }
  text += "\n\t" + Inline(option.get_description());
  if (const auto& words = line.WordsOf(option); !words.empty()) {
    text += "\n\n\tOne of: " + Inline(fmt::format("{}", fmt::join(words, ",")));
  }
  const std::string standard = option.get_default_str();
  if (!standard.empty()) text += "\n\n\tDefault: " + Inline(standard);
  return text + "\n\n";
}

std::string Options(const CommandLine& line, const CLI::App& command) {
  std::string text;
  for (const bool positional : {true, false}) {
    for (const CLI::Option* option : command.get_options()) {
      if (option->get_positional() == positional) text += OptionText(line, *option);
    }
  }
  return text;
}

std::string Subcommands(const CommandLine& line, const CLI::App& command, const std::string& name) {
  std::string text;
  for (const CLI::App* sub : command.get_subcommands({})) {
    text += fmt::format("## {} {}\n\n{}\n\n{}\n\n{}", name, sub->get_name(),
                        Usage(*sub, name + " " + sub->get_name()), Inline(sub->get_description()),
                        Options(line, *sub));
  }
  return text.empty() ? "" : "# COMMANDS\n\n" + text;
}

std::string Head(const std::string& name, int section, const std::string& about) {
  return fmt::format("{0}({1})\n\n# NAME\n\n{0} - {2}\n\n", name, section, Inline(about));
}

std::string VerbPage(const CommandLine& line, const CLI::App& command) {
  const std::string name = "contactctl " + command.get_name();
  std::string page = Head("contactctl-" + command.get_name(), 1, command.get_description());
  page += fmt::format("# SYNOPSIS\n\n{}\n\n# DESCRIPTION\n\n{}.\n\n{}\n", Usage(command, name),
                      Inline(command.get_description()), Paragraphs(command.get_footer()));
  page += "# OPTIONS\n\nThe options of *contactctl*(1), and:\n\n" + Options(line, command);
  page += Subcommands(line, command, name);
  return page + "# SEE ALSO\n\n*contactctl*(1), *contact-scenario*(5), *contactd*(8)\n";
}

std::string MainPage(const CommandLine& line) {
  const CLI::App& app = line.app();
  std::string page = Head("contactctl", 1, "simulate contacts on a contactd server");
  page += "# SYNOPSIS\n\n*contactctl* [options] COMMAND ...\n\n# DESCRIPTION\n\n" +
          Block(app.get_description()) + "\n# COMMANDS\n\n";
  for (const CLI::App* command : app.get_subcommands({})) {
    page += fmt::format("*contactctl-{}*(1)\n\t{}\n\n", Inline(command->get_name()),
                        Inline(command->get_description()));
  }
  page += "# OPTIONS\n\n" + Options(line, app);
  page += "# ENVIRONMENT AND FILES\n\n" + Paragraphs(app.get_subcommand("config")->get_footer());
  page += "\n# EXIT STATUS\n\n" + Paragraphs(app.get_footer());
  return page + "\n# SEE ALSO\n\n*contact-scenario*(5), *contactd*(8)\n";
}

std::string ScenarioPage() {
  std::string page = Head("contact-scenario", 5, "scenario and sweep files of contactctl");
  page +=
      "# DESCRIPTION\n\nA scenario file is one Scenario, a sweep file one Sweep, in YAML or JSON. "
      "A mapping *variables* at its top has names and values; ${name} stands for the value "
      "wherever "
      "a value stands, in quotes within braces, and $${ is ${ itself. *--var* gives other values. "
      "What else may stand in them follows.\n\n# FIELDS\n\n";
  for (const Chapter& chapter : ScenarioReference(Contract())) {
    page += fmt::format("## {}\n\n{}\n", chapter.name, Paragraphs(chapter.text));
    for (const Term& field : chapter.fields) {
      page +=
          fmt::format("*{}* ({})\n\t{}\n\n", Inline(field.name), field.type, Inline(field.text));
      for (const Term& value : field.values) {
        page += fmt::format("\t*{}*: {}\n\n", Inline(value.name), Inline(value.text));
      }
    }
  }
  return page + "# SEE ALSO\n\n*contactctl-run*(1), *contactctl-schema*(1)\n";
}

std::string Help(const std::string& program) {
  const std::optional<std::string> text = OutputOf({program, "--help"});
  if (!text) throw Failure(ExitCode::kLocal, program + " --help does not tell its settings");
  return text->substr(0, text->find_last_not_of('\n') + 1);
}

std::string ServerPage(const std::string& program) {
  return Head("contactd", 8, "run contact simulations as jobs") +
         "# SYNOPSIS\n\n*contactd* [options]\n\n# OPTIONS\n\n" + Block(Help(program)) +
         "\n# FILES\n\nThe file of *--config* has a line *name = value* for each option. A flag "
         "wins over the variable, and that over the file.\n\n"
         "# SIGNALS\n\nSIGTERM and SIGINT end it in order: running jobs go back into the queue, "
         "and go on at the next start.\n\n"
         "# EXIT STATUS\n\n0 ended by a signal, 1 internal error or failed disk, 2 wrong setting, "
         "3 data directory or address is in use\n\n# SEE ALSO\n\n*contactctl*(1)\n";
}

}  // namespace

void WriteManual(const CommandLine& line, const std::string& folder, const std::string& contactd) {
  const auto write = [&folder](const std::string& page, const std::string& text) {
    WriteText(text, fmt::format("{}/{}.scd", folder, page));
  };
  write("contactctl.1", MainPage(line));
  for (const CLI::App* command : line.app().get_subcommands({})) {
    write(fmt::format("contactctl-{}.1", command->get_name()), VerbPage(line, *command));
  }
  write("contact-scenario.5", ScenarioPage());
  write("contactd.8", ServerPage(contactd));
}

}  // namespace contact::cli
