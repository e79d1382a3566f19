// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/command_line.h>
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <base/program.h>
#include <base/unknown_name.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <filesystem>
#include <functional>

namespace Ricochet
{
  namespace
  {
    /// An option: from here come the parser, the help, the manual page and the completion.
    struct Option
    {
      std::string name;
      /// Its value for the help; empty for an option without one. In brackets: may be left out.
      std::string value, description;
      std::function<void(CommandLine &, const std::string &)> take;
      /// Words that the value may be.
      std::vector<std::string> choices = {};
    };

    /// An option that sets @p member.
    Option
    flag(const std::string &name,
         const std::string &description,
         bool CommandLine::*member)
    {
      return {name,
              "",
              description,
              [member](CommandLine &line, const std::string &) {
                line.*member = true;
              }};
    }

    const std::vector<Option> &
    options()
    {
      static const std::vector<Option> all = {
        {"--set",
         "\"Section/Name=value\"",
         "override one parameter; may be repeated",
         [](CommandLine &line, const std::string &value) {
           line.assignments.push_back(value);
         }},
        {"--output-dir",
         "DIR",
         "folder for all output (default: Output/Folder)",
         [](CommandLine &line, const std::string &value) {
           line.output_dir = value;
         }},
        flag("--overwrite",
             "replace the run of another file in it",
             &CommandLine::overwrite),
        flag("--resume",
             "continue from the checkpoint in the output folder",
             &CommandLine::resume),
        flag(
          "--certify",
          "run it also with cells and steps halved once and twice: error bars",
          &CommandLine::certify),
        flag("--validate",
             "check the parameters and stop",
             &CommandLine::validate_only),
        {"--print-parameters",
         "[SECTION]",
         "print all parameters, or those of a section, with their documentation",
         [](CommandLine &line, const std::string &value) {
           line.print_parameters = true;
           line.section          = value;
         }},
        flag("--list",
             "print all parameters, one on a line, with what is allowed",
             &CommandLine::list),
        flag("--quiet",
             "no lines on the console but errors (log.txt has them)",
             &CommandLine::quiet),
        {"--progress",
         "json",
         "a line of JSON for each step in place of the log on the console",
         [](CommandLine &line, const std::string &) {
           line.json_progress = true;
         },
         {"json"}},
        flag("--json",
             "refusals, --validate and --print-parameters as JSON",
             &CommandLine::json),
        {"--completion",
         "SHELL",
         "print a script by which bash or zsh completes the command line",
         [](CommandLine &line, const std::string &value) {
           line.completion = value;
         },
         {"bash", "zsh"}},
        flag("--manual", "print a manual page for man", &CommandLine::manual),
        flag("--help", "print this", &CommandLine::help),
        flag("--version",
             "print the versions of this program and of deal.II",
             &CommandLine::version)};
      return all;
    }

    /// Options of Program::tables, which other programs refuse by name.
    const std::vector<std::string> names_of_tables = {"--promises",
                                                      "--combinations"};

    bool
    is_optional(const Option &option)
    {
      return !option.value.empty() && option.value[0] == '[';
    }

    /// Whether @p word may be the value of --print-parameters: a parameter file is none.
    bool
    may_be_section(const std::string &word)
    {
      std::error_code error;
      return !word.empty() && word[0] != '-' &&
        std::filesystem::path(word).extension() != ".prm" &&
        !std::filesystem::exists(word, error);
    }

    [[noreturn]] void
    refuse_option(const std::string &name)
    {
      std::vector<std::string> known = names_of_tables;
      for (const Option &option : options())
        known.push_back(option.name);
      throw unknown_name("There is no option '" + name + "'",
                         name,
                         known,
                         " See --help.",
                         "unknown_option");
    }

    /// The value of @p option, or nothing.
    std::string
    checked_value(const Option &option, const std::string &value)
    {
      const auto &choices = option.choices;
      if (!choices.empty() &&
          std::find(choices.begin(), choices.end(), value) == choices.end())
        {
          std::string words;
          for (const std::string &choice : choices)
            words += (words.empty() ? "" : " or ") + choice;
          throw InputError("The option " + option.name + " takes " + words +
                           ", not '" + value + "'.");
        }
      return value;
    }
  } // namespace



  CommandLine
  parse_command_line(const int argc, char **argv)
  {
    const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    CommandLine                    command_line;
    for (std::size_t i = 0; i < words.size(); ++i)
      {
        const std::string &word = words[i] == "-h" ? "--help" : words[i];
        const auto         option =
          std::find_if(options().begin(),
                       options().end(),
                       [&](const Option &one) { return one.name == word; });
        if (option != options().end())
          {
            std::string value;
            if (is_optional(*option))
              {
                if (i + 1 < words.size() && may_be_section(words[i + 1]))
                  value = words[++i];
              }
            else if (!option->value.empty())
              {
                const std::string needs =
                  "The option " + word + " needs a value after it";
                if (++i == words.size())
                  throw InputError(needs + ".");
                if (words[i].empty() || words[i].compare(0, 2, "--") == 0)
                  throw InputError(needs + ", not '" + words[i] + "'.");
                value = checked_value(*option, words[i]);
              }
            option->take(command_line, value);
          }
        else if (std::find(names_of_tables.begin(),
                           names_of_tables.end(),
                           word) != names_of_tables.end())
          command_line.table = word;
        else if (word.empty())
          throw InputError("The name of the parameter file is empty.");
        else if (word[0] == '-')
          refuse_option(word);
        else if (command_line.parameter_file.empty())
          command_line.parameter_file = word;
        else
          throw InputError("Two parameter files were given, '" +
                           command_line.parameter_file + "' and '" + word +
                           "'; a run has one. Use 'include' in a file to "
                           "combine several.");
      }
    if (command_line.resume && command_line.overwrite)
      throw InputError(
        "--resume goes on with the run in the folder, "
        "--overwrite replaces it: give one of them.");
    return command_line;
  }



  namespace
  {
    /// A line of a table with two columns.
    struct Line
    {
      std::string left, right;
    };

    std::vector<Line>
    lines_of_options(const Program &program)
    {
      std::vector<Line> lines;
      for (const Option &option : options())
        lines.push_back(
          {option.name + (option.value.empty() ? "" : " " + option.value),
           option.description});
      for (const Program::Table &table : program.tables)
        lines.push_back({table.option, table.description});
      return lines;
    }

    std::vector<Line>
    examples(const Program &program)
    {
      const std::string &name = program.name;
      return {{name + " mine.prm", "run it"},
              {name + " mine.prm --validate", "check it without a run"},
              {name + " mine.prm --set \"Time/Time step=0.001\"",
               "with another step"},
              {name + " mine.prm --certify", "with error bars"},
              {name + " --print-parameters Contact", "explain a section"},
              {name + " --list | grep -i friction", "find a parameter"},
              {"mpirun -n 4 " + name + " mine.prm", "on four ranks"},
              {"source <(" + name + " --completion bash)",
               "complete names after --set"}};
    }

    const std::vector<Line> environment = {
      {"OMP_NUM_THREADS",
       "threads of one rank (default: the cores, divided among the ranks)"},
      {"OPENBLAS_NUM_THREADS",
       "1 starts the program sooner, which uses no more"}};

    const std::vector<Line> exit_codes = {
      {"0", "the run is complete, and its energy is what it says"},
      {"1", "the input is refused; nothing was computed"},
      {"2", "the computation stopped; checkpoint and table are written"},
      {"3", "an error of the program"},
      {"4",
       "the run is complete, its balance of energy or a promise is not kept"},
      {"130, 143", "stopped by Ctrl-C or SIGTERM; --resume goes on"}};

    const std::string without_file =
      "Without FILE.prm all parameters have their default values.";

    std::string
    usage(const Program &program)
    {
      return program.name + " [FILE.prm] [options]";
    }

    /// @p lines with the right column below each other.
    std::string
    as_columns(const std::vector<Line> &lines, const std::string &prefix = "  ")
    {
      std::size_t width = 0;
      for (const Line &line : lines)
        width = std::max(width, line.left.size());
      std::string text;
      for (const Line &line : lines)
        text += prefix + line.left +
          std::string(width + 2 - line.left.size(), ' ') + line.right + "\n";
      return text;
    }

    /// Text for the macros of man: hyphens that can be searched, no commands at line begins.
    std::string
    for_man(std::string text)
    {
      boost::replace_all(text, "\\", "\\e");
      boost::replace_all(text, "-", "\\-");
      boost::replace_all(text, "\n.", "\n\\&.");
      return text;
    }

    std::string
    quoted_for_shell(std::string text)
    {
      boost::replace_all(text, "'", "'\\''");
      return "'" + text + "'";
    }
  } // namespace



  std::string
  help_text(const Program &program)
  {
    return program.description + "\n\nUsage: " + usage(program) + "\n" +
      as_columns(lines_of_options(program)) + without_file + "\n\nExamples:\n" +
      as_columns(examples(program)) + "\nEnvironment:\n" +
      as_columns(environment) + "\nExit codes:\n" + as_columns(exit_codes);
  }



  std::string
  manual_page(const Program &program)
  {
    const auto section = [](const std::string       &title,
                            const std::vector<Line> &lines) {
      std::string text = ".SH " + title + "\n";
      for (const Line &line : lines)
        text +=
          ".TP\n.B " + for_man(line.left) + "\n" + for_man(line.right) + "\n";
      return text;
    };
    return ".TH " + program.name +
      " 1 \"\" \"Ricochet " RICOCHET_VERSION "\"\n" + ".SH NAME\n" +
      for_man(program.name) +
      " \\- dynamic contact of elastic bodies\n.SH SYNOPSIS\n.B " +
      for_man(usage(program)) + "\n.SH DESCRIPTION\n" +
      for_man(program.description + "\n" + without_file) + "\n" +
      section("OPTIONS", lines_of_options(program)) +
      section("EXAMPLES", examples(program)) +
      section("ENVIRONMENT", environment) + section("EXIT STATUS", exit_codes);
  }



  std::string
  completion_script(const Program                  &program,
                    const std::string              &shell,
                    const std::vector<std::string> &parameters,
                    const std::vector<std::string> &sections)
  {
    const auto list = [](const std::vector<std::string> &words) {
      std::string text;
      for (const std::string &word : words)
        text += "    " + quoted_for_shell(word) + "\n";
      return text;
    };
    std::vector<std::string> names, settings;
    for (const Option &option : options())
      names.push_back(option.name);
    for (const Program::Table &table : program.tables)
      names.push_back(table.option);
    for (const std::string &parameter : parameters)
      settings.push_back(parameter + "=");
    const std::string function = "_ricochet_" + program.name;
    std::string       cases;
    const auto        add_case = [&](const std::string              &option,
                              const std::vector<std::string> &choices) {
      cases += "    " + option + ") choices=(\n" + list(choices) + "    ) ;;\n";
    };
    for (const Option &option : options())
      if (!option.choices.empty())
        add_case(option.name, option.choices);
    add_case("--set", settings);
    add_case("--print-parameters", sections);
    if (shell == "zsh")
      return "#compdef " + program.name + "\n" + function +
        "() {\n  local option=${words[CURRENT-1]}\n  local -a choices\n"
        "  case $option in\n" +
        cases +
        "    --output-dir) _files -/; return ;;\n"
        "    *) _files -g '*.prm'\n    choices=(\n" +
        list(names) +
        "    ) ;;\n  esac\n  compadd -S '' -a choices\n}\ncompdef " + function +
        " " + program.name + "\n";
    // Within an open quotation mark the shell itself protects blanks.
    return function +
      "() {\n  local word=\"${COMP_WORDS[COMP_CWORD]}\" choices=() choice\n"
      "  local plain=\"${word//[\\\\\\\"\\']/}\"\n  COMPREPLY=()\n"
      "  case \"${COMP_WORDS[COMP_CWORD-1]}\" in\n" +
      cases +
      "    --output-dir) COMPREPLY=($(compgen -d -- \"$word\")); return ;;\n"
      "    *) COMPREPLY=($(compgen -f -X '!*.prm' -- \"$word\"))\n    choices=(\n" +
      list(names) +
      "    ) ;;\n  esac\n  for choice in \"${choices[@]}\"; do\n"
      "    [[ \"$choice\" == \"$plain\"* ]] || continue\n"
      "    [[ \"$word\" == [\\\"\\']* ]] || choice=$(printf '%q' \"$choice\")\n"
      "    COMPREPLY+=(\"$choice\")\n  done\n}\n"
      "complete -o nospace -F " +
      function + " " + program.name + "\n";
  }
} // namespace Ricochet
