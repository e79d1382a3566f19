// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <base/program.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
#include <iostream>
#include <sstream>

namespace Ricochet
{
  CommandLine
  parse_command_line(const int argc, char **argv)
  {
    CommandLine command_line;

    int        i          = 1;
    const auto next_value = [&](const std::string &option) {
      if (i + 1 >= argc)
        throw InputError("The option " + option + " needs a value after it.");
      const std::string value = argv[++i];
      if (value.empty() || value.compare(0, 2, "--") == 0)
        throw InputError("The option " + option +
                         " needs a value after it, not '" + value + "'.");
      return value;
    };
    for (; i < argc; ++i)
      {
        const std::string argument = argv[i];
        if (argument == "--set")
          command_line.assignments.push_back(next_value(argument));
        else if (argument == "--output-dir")
          command_line.output_dir = next_value(argument);
        else if (argument == "--resume")
          command_line.resume = true;
        else if (argument == "--validate")
          command_line.validate_only = true;
        else if (argument == "--print-parameters")
          command_line.print_parameters = true;
        else if (argument == "--quiet")
          command_line.quiet = true;
        else if (argument == "--help" || argument == "-h")
          command_line.help = true;
        else if (argument == "--version")
          command_line.version = true;
        else if (!argument.empty() && argument[0] == '-')
          {
            std::string message = "There is no option '" + argument + "'.";
            const auto  names   = nearest_names(argument,
                                             {"--set",
                                                 "--output-dir",
                                                 "--resume",
                                                 "--validate",
                                                 "--print-parameters",
                                                 "--quiet",
                                                 "--help",
                                                 "--version"},
                                             1);
            if (!names.empty())
              message += " Is " + names[0] + " meant?";
            throw InputError(message + " See --help.");
          }
        else if (command_line.parameter_file.empty())
          command_line.parameter_file = argument;
        else
          throw InputError("Two parameter files were given, '" +
                           command_line.parameter_file + "' and '" + argument +
                           "'; a run has one. Use 'include' in a file to "
                           "combine several.");
      }
    return command_line;
  }



  RunFolder::RunFolder(const std::string &path,
                       const MPI_Comm     communicator,
                       const bool         resume,
                       const bool         quiet)
    : communicator(communicator)
    , is_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , resume(resume)
    , path(path)
    , quiet(quiet)
  {
    std::string problem;
    if (is_root)
      {
        std::error_code error;
        std::filesystem::create_directories(path, error);
        if (error)
          problem = error.message();
        else
          {
            log_file.open(file("log.txt"),
                          resume ? std::ios::app : std::ios::trunc);
            if (!log_file)
              problem = "no file can be created in it";
          }
      }
    problem = dealii::Utilities::MPI::broadcast(communicator, problem, 0);
    if (!problem.empty())
      throw InputError("The output folder '" + path +
                       "' cannot be written to: " + problem + ".");
  }



  void
  RunFolder::log(const std::string &line)
  {
    if (!is_root)
      return;
    log_file << line << std::endl;
    if (!quiet)
      std::cout << line << std::endl;
  }



  std::string
  RunFolder::file(const std::string &name) const
  {
    return (std::filesystem::path(path) / name).string();
  }



  namespace
  {
    void
    print_help(const Program &program)
    {
      std::cout
        << program.description << "\n\n"
        << "Usage: " << program.name
        << " [FILE.prm] [options]\n"
           "  --set \"Section/Name=value\"  override one parameter; may be "
           "repeated\n"
           "  --output-dir DIR            folder for all output (default: "
           "Output/Folder)\n"
           "  --resume                    continue from the checkpoint in the "
           "output folder\n"
           "  --validate                  check the parameters and stop\n"
           "  --print-parameters          print all parameters with their "
           "documentation\n"
           "  --quiet                     no lines on the console (log.txt has "
           "them)\n"
           "  --help, --version\n"
           "Without FILE.prm all parameters have their default values.\n"
           "In parallel: mpirun -n N "
        << program.name << " FILE.prm ...\n";
    }



    /// The parameters but for those that say what to write, when to stop, and
    /// how hard the solvers try.
    std::string
    parameters_that_matter(dealii::ParameterHandler &parameters)
    {
      std::stringstream all;
      parameters.print_parameters(all, dealii::ParameterHandler::ShortText);
      std::string kept, line;
      bool        skipping = false;
      while (std::getline(all, line))
        {
          const std::string text = dealii::Utilities::trim(line);
          if (text == "subsection Output" || text == "subsection Newton" ||
              text == "subsection Linear solver")
            skipping = true;
          else if (skipping)
            skipping = (text != "end");
          else if (text.find("set Final time") != 0 &&
                   text.find("set Maximum halvings") != 0)
            kept += text + "\n";
        }
      return kept;
    }



    void
    execute(const int argc, char **argv, const Program &program)
    {
      const MPI_Comm communicator = MPI_COMM_WORLD;
      const bool     is_root =
        dealii::Utilities::MPI::this_mpi_process(communicator) == 0;

      const CommandLine command_line = parse_command_line(argc, argv);
      if (command_line.help)
        {
          if (is_root)
            print_help(program);
          return;
        }
      if (command_line.version)
        {
          if (is_root)
            std::cout << program.name << " of Ricochet " << RICOCHET_VERSION
                      << " (" << RICOCHET_BUILD_TYPE << "), deal.II "
                      << DEAL_II_PACKAGE_VERSION << std::endl;
          return;
        }

      dealii::ParameterHandler parameters;
      std::string              output_dir = "output/" + program.name;
      parameters.enter_subsection("Output");
      parameters.add_parameter("Folder",
                               output_dir,
                               "Folder for all output of the run. On the "
                               "command line: --output-dir.",
                               dealii::Patterns::DirectoryName());
      parameters.leave_subsection();
      program.add_parameters(parameters);
      if (!command_line.parameter_file.empty())
        read_parameter_file(command_line.parameter_file, parameters);
      for (const std::string &assignment : command_line.assignments)
        set_parameter(assignment, parameters);

      if (command_line.print_parameters)
        {
          if (is_root)
            parameters.print_parameters(std::cout,
                                        dealii::ParameterHandler::Text);
          return;
        }

      program.validate();
      if (command_line.validate_only)
        {
          if (is_root)
            std::cout << "The parameters are valid." << std::endl;
          return;
        }

      RunFolder folder(command_line.output_dir.empty()
                         ? output_dir
                         : command_line.output_dir,
                       communicator,
                       command_line.resume,
                       command_line.quiet);
      if (is_root)
        {
          namespace fs = std::filesystem;
          std::error_code error;
          if (!command_line.parameter_file.empty() && !command_line.resume)
            fs::copy_file(
              command_line.parameter_file,
              folder.file(
                fs::path(command_line.parameter_file).filename().string()),
              fs::copy_options::overwrite_existing,
              error);
          // An attempt to resume with other parameters must not overwrite the
          // ones that the results in the folder belong to.
          std::ofstream all(folder.file(
            command_line.resume ? "parameters.resumed.prm" : "parameters.prm"));
          parameters.print_parameters(all, dealii::ParameterHandler::Text);
        }
      folder.parameters_that_matter = parameters_that_matter(parameters);
      folder.log(
        program.name + ", Ricochet " + RICOCHET_VERSION + " (" +
        RICOCHET_BUILD_TYPE + "), deal.II " + DEAL_II_PACKAGE_VERSION + ", " +
        std::to_string(dealii::Utilities::MPI::n_mpi_processes(communicator)) +
        " MPI rank(s)");
      program.run(folder);
    }
  } // namespace



  int
  run_program(const int argc, char **argv, const Program &program)
  {
    // One thread per rank: the parallelism of Ricochet is MPI.
    int                                      mpi_argc = argc;
    char                                   **mpi_argv = argv;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, mpi_argv, 1);
    const bool                               is_root =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

    // A stack trace in an assertion helps nobody who runs a finished program.
    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();

    const auto report = [&](const std::string &kind, const std::string &text) {
      if (is_root)
        std::cerr << "\n"
                  << program.name << ": " << kind << "\n"
                  << text << "\n"
                  << std::endl;
    };
    try
      {
        execute(argc, argv, program);
      }
    catch (const InputError &error)
      {
        // Thrown alike on all ranks.
        report("the input is not valid.", error.what());
        return 1;
      }
    catch (const ComputationError &error)
      {
        report("the computation stopped.", error.what());
        return 2;
      }
    catch (const std::exception &error)
      {
        // Possibly on one rank only: the others must not wait for ever.
        std::cerr << program.name << ": an error that should not happen.\n"
                  << error.what() << std::endl;
        if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
          MPI_Abort(MPI_COMM_WORLD, 3);
        return 3;
      }
    return 0;
  }
} // namespace Ricochet
