// SPDX-License-Identifier: Apache-2.0
#include "cli/shell_text.h"

#include <cctype>
#include <vector>

namespace ridgeline {
namespace {

using Option = const CLI::Option*;

std::vector<const CLI::App*> CommandsOf(const CLI::App& app) {
  std::vector<const CLI::App*> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (!command->get_name().empty()) commands.push_back(command);
  }
  return commands;
}

std::vector<Option> OptionsOf(const CLI::App& app) {
  const std::vector<Option> all = app.get_options([](Option) { return true; });
  std::vector<Option> named;
  for (const Option option : all) {
    if (!option->get_positional()) named.push_back(option);
  }
  return named;
}

std::vector<Option> PositionalsOf(const CLI::App& app) {
  return app.get_options([](Option option) { return option->get_positional(); });
}

std::vector<std::string> NamesOf(Option option) {
  std::vector<std::string> names;
  for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

bool TakesValue(Option option) { return option->get_items_expected_max() > 0; }

// The choices of an option checked by CLI::IsMember, whose type name ends in ":{a,b}"; else none.
std::vector<std::string> ChoicesOf(Option option) {
  const std::string type = option->get_type_name();
  const std::size_t open = type.find('{');
  const std::size_t close = type.rfind('}');
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

std::string Join(const std::vector<std::string>& parts, const std::string& separator) {
  return CLI::detail::join(parts, separator);
}

std::string AllNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const Option option : OptionsOf(app)) {
    for (std::string& name : NamesOf(option)) names.push_back(std::move(name));
  }
  return Join(names, " ");
}

// Cases of the options of an app that have a list of choices.
std::string BashChoiceCases(const CLI::App& app) {
  std::string cases;
  for (const Option option : OptionsOf(app)) {
    const auto choices = ChoicesOf(option);
    if (choices.empty()) continue;
    cases += "      " + app.get_name() + ":" + NamesOf(option).back() + ") words='" +
             Join(choices, " ") + "' ;;\n";
  }
  return cases;
}

// Text in single quotes of a shell.
std::string Quoted(const std::string& text) {
  return "'" + CLI::detail::find_and_replace(text, "'", "'\\''") + "'";
}

// Text within the brackets of zsh's _arguments.
std::string ZshText(std::string text) {
  for (const char* c : {"\\", "[", "]", ":"}) {
    text = CLI::detail::find_and_replace(text, c, std::string("\\") + c);
  }
  return text;
}

std::string ZshArgument(Option option) {
  const auto names = NamesOf(option);
  const auto choices = ChoicesOf(option);
  std::string value;
  if (TakesValue(option)) {
    value = choices.empty() ? ":value:_files" : ":value:(" + Join(choices, " ") + ")";
  }
  std::string lines;
  for (const std::string& name : names) {
    lines += "        " + Quoted(name + "[" + ZshText(option->get_description()) + "]" + value) +
             " \\\n";
  }
  return lines;
}

std::string Troff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  if (!escaped.empty() && (escaped[0] == '.' || escaped[0] == '\'')) escaped.insert(0, "\\&");
  return CLI::detail::find_and_replace(escaped, "\n.", "\n\\&.");
}

std::string Upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string OptionManual(Option option) {
  const bool positional = option->get_positional();
  std::string text =
      ".TP\n.B " + Troff(positional ? option->get_name(true) : Join(NamesOf(option), ", "));
  const std::string type = option->get_type_name();
  if (!positional && TakesValue(option)) text += " " + Troff(type.substr(0, type.find(':')));
  std::string description = option->get_description();
  if (!option->get_default_str().empty()) description += " [" + option->get_default_str() + "]";
  return text + "\n" + Troff(description) + "\n";
}

std::string OptionsManual(const CLI::App& app) {
  std::string text;
  for (const Option option : PositionalsOf(app)) text += OptionManual(option);
  for (const Option option : OptionsOf(app)) text += OptionManual(option);
  return text;
}

constexpr const char* kExitCodes =
    ".SH EXIT STATUS\n0: pose found, or work done; 1: internal error; 2: bad input or usage; 3: "
    "abstained; 130: interrupted.\n";

}  // namespace

std::string BashCompletion(const CLI::App& program) {
  std::vector<std::string> commands;
  std::string options;
  std::string choices = BashChoiceCases(program);
  for (const CLI::App* command : CommandsOf(program)) {
    commands.push_back(command->get_name());
    options += "    " + command->get_name() + ") options='" + AllNames(*command) + "' ;;\n";
    choices += BashChoiceCases(*command);
  }
  return "# bash completion for ridgeline; made by `ridgeline completion bash`\n"
         "_ridgeline() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local command= options= words= i\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    case ${COMP_WORDS[i]} in -*) ;; *) command=${COMP_WORDS[i]}; break ;; esac\n"
         "  done\n"
         "  case $command in\n" +
         options + "    *) words='" + Join(commands, " ") + " " + AllNames(program) +
         "' ;;\n"
         "  esac\n"
         "  case $command:$previous in\n" +
         CLI::detail::find_and_replace(choices, "      ", "    ") +
         "  esac\n"
         "  if [[ -n $words ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
         "  elif [[ $word == -* ]]; then\n"
         "    COMPREPLY=($(compgen -W \"$options " +
         AllNames(program) +
         "\" -- \"$word\"))\n"
         "  else\n"
         "    compopt -o filenames\n"
         "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
         "  fi\n"
         "}\n"
         "complete -F _ridgeline ridgeline\n";
}

std::string ZshCompletion(const CLI::App& program) {
  std::string commands;
  std::string cases;
  for (const CLI::App* command : CommandsOf(program)) {
    commands +=
        "    " + Quoted(command->get_name() + ":" + ZshText(command->get_description())) + "\n";
    cases += "    " + command->get_name() + ")\n      _arguments \\\n";
    for (const Option option : OptionsOf(*command)) cases += ZshArgument(option);
    cases += "        '*:file:_files' ;;\n";
  }
  std::string globals;
  for (const Option option : OptionsOf(program)) globals += ZshArgument(option);
  return "#compdef ridgeline\n"
         "# zsh completion for ridgeline; made by `ridgeline completion zsh`\n"
         "_ridgeline() {\n"
         "  local -a commands\n  commands=(\n" +
         commands +
         "  )\n"
         "  local state line\n"
         "  _arguments -C \\\n" +
         globals +
         "        '1:command:->command' '*::argument:->argument'\n"
         "  if [[ $state == command ]]; then\n"
         "    _describe command commands\n"
         "    return\n"
         "  fi\n"
         "  case $line[1] in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_ridgeline \"$@\"\n";
}

std::string ProgramManual(const CLI::App& program) {
  std::string text = ".TH RIDGELINE 1\n.SH NAME\nridgeline \\- " +
                     Troff(program.get_description()) +
                     "\n.SH SYNOPSIS\n.B ridgeline\n[options] command [arguments]\n"
                     ".SH COMMANDS\n";
  for (const CLI::App* command : CommandsOf(program)) {
    text += ".TP\n.BR ridgeline\\-" + Troff(command->get_name()) + " (1)\n" +
            Troff(command->get_description()) + "\n";
  }
  return text + ".SH OPTIONS\n" + OptionsManual(program) + kExitCodes;
}

std::string CommandManual(const CLI::App& program, const CLI::App& command) {
  const std::string name = command.get_name();
  std::string positionals;
  for (const Option option : PositionalsOf(command)) positionals += " " + option->get_name(true);
  return ".TH RIDGELINE\\-" + Upper(name) + " 1\n.SH NAME\nridgeline\\-" + Troff(name) + " \\- " +
         Troff(command.get_description()) + "\n.SH SYNOPSIS\n.B ridgeline " + Troff(name) +
         "\n[options]" + Troff(positionals) + "\n.SH OPTIONS\n" + OptionsManual(command) +
         ".SH GLOBAL OPTIONS\n" + OptionsManual(program) + ".SH EXAMPLE\n.nf\n" +
         Troff(command.get_footer()) + "\n.fi\n" + kExitCodes + ".SH SEE ALSO\n.BR ridgeline (1)\n";
}

}  // namespace ridgeline
