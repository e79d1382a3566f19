// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/run_folder.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>
#include <sstream>
#include <vector>

namespace Ricochet
{
  namespace
  {
    // What a run leaves in its folder.
    const std::string              identity_file = "run.txt";
    const std::vector<std::string> result_files  = {"checkpoint.bin",
                                                    "energy.csv",
                                                    "energy.h5",
                                                    "solution.pvd",
                                                    "obstacles.pvd",
                                                    "log.txt",
                                                    "parameters.prm",
                                                    "parameters.resumed.prm"};

    /// The name of the copy of a parameter file in the folder.
    std::string
    name_of_copy(const std::string &parameter_file)
    {
      return std::filesystem::path(parameter_file).filename().string();
    }

    /// The text after @p key in the line that begins with it.
    std::string
    entry(const std::string &text, const std::string &key)
    {
      std::istringstream lines(text);
      std::string        line;
      while (std::getline(lines, line))
        if (line.compare(0, key.size(), key) == 0)
          return line.substr(key.size());
      return {};
    }

    bool
    exists(const std::string &file)
    {
      std::error_code error;
      return std::filesystem::exists(file, error);
    }

    /// Whether both names are there and mean one file.
    bool
    same_file(const std::string &a, const std::string &b)
    {
      std::error_code error;
      return !a.empty() && !b.empty() &&
        std::filesystem::equivalent(a, b, error) && !error;
    }
  } // namespace



  RunFolder::RunFolder(const Options &options, const MPI_Comm communicator)
    : communicator(communicator)
    , is_root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , resume(options.resume)
    , options(options)
  {
    namespace fs = std::filesystem;
    on_first_rank(communicator, [&]() {
      std::error_code error;
      fs::create_directories(options.path, error);
      if (error)
        throw InputError("The output folder '" + options.path +
                         "' cannot be written to: " + error.message() + ".");
      lock.take(options.path);
      identity = "program = " + options.program + "\nparameter file = ";
      if (!options.parameter_file.empty())
        identity +=
          fs::weakly_canonical(options.parameter_file, error).string();
      identity += "\n";
      for (const std::string &name : result_files)
        if (fs::is_directory(file(name), error))
          throw InputError("The output folder '" + options.path +
                           "' cannot be used: '" + name +
                           "' in it is a folder.");
      if (exists(file("solution")) &&
          !fs::is_directory(file("solution"), error))
        throw InputError("The output folder '" + options.path +
                         "' cannot be used: 'solution' in it is a file, and "
                         "fields go to a folder of that name.");
      if (!options.resume && !options.overwrite)
        check_whose_run_it_holds();
    });
  }



  void
  RunFolder::check_whose_run_it_holds() const
  {
    const auto refuse = [&](const std::string &whose) {
      throw InputError("The output folder '" + options.path +
                       "' holds the results of " + whose +
                       ". Name another folder with --output-dir, or take "
                       "their place with --overwrite.");
    };
    if (!exists(file(identity_file)))
      {
        for (const std::string &name : result_files)
          if (exists(file(name)))
            refuse("an unknown run");
        return;
      }
    const std::string found = read_file(file(identity_file));
    if (found == identity)
      return;
    const std::string program = entry(found, "program = ");
    const std::string other   = entry(found, "parameter file = ");
    // A file that was moved, or came with the folder from elsewhere, is still
    // the same file.
    if (program == options.program && !other.empty() &&
        !options.parameter_file.empty() &&
        name_of_copy(other) == name_of_copy(options.parameter_file) &&
        exists(file(name_of_copy(other))) &&
        read_file(file(name_of_copy(other))) ==
          read_file(options.parameter_file))
      return;
    refuse(program +
           (other.empty() ? " without a parameter file" : " with " + other));
  }



  void
  RunFolder::remove_earlier_results() const
  {
    namespace fs = std::filesystem;
    // The checkpoint first: from then on nothing can be resumed by mistake.
    std::vector<std::string> names = result_files;
    if (exists(file(identity_file)))
      {
        const std::string other =
          entry(read_file(file(identity_file)), "parameter file = ");
        // A parameter file that lies in the folder itself is no copy.
        if (!other.empty() && !same_file(file(name_of_copy(other)), other))
          names.push_back(name_of_copy(other));
      }
    for (const std::string &name : names)
      {
        if (same_file(file(name), options.parameter_file))
          continue;
        std::error_code error;
        fs::remove(file(name), error);
        if (error)
          throw ComputationError(
            "'" + file(name) + "' cannot be removed: " + error.message() + ".");
        fs::remove(file(name + ".new"), error);
      }
    std::error_code error;
    for (const auto &field : fs::directory_iterator(file("solution"), error))
      {
        const std::string name = field.path().filename().string();
        if (name.compare(0, 5, "step-") == 0 ||
            name.compare(0, 10, "obstacles-") == 0)
          fs::remove(field.path(), error);
      }
  }



  void
  RunFolder::begin()
  {
    if (begun)
      return;
    begun = true;
    on_first_rank(communicator, [&]() {
      if (resume)
        // An attempt to resume with other parameters must not overwrite the
        // ones that the results in the folder belong to.
        write_atomically(file("parameters.resumed.prm"), all_parameters);
      else
        {
          remove_earlier_results();
          write_atomically(file(identity_file), identity);
          const std::string &given = options.parameter_file;
          if (!given.empty() && !same_file(file(name_of_copy(given)), given))
            write_atomically(file(name_of_copy(given)), read_file(given));
          write_atomically(file("parameters.prm"), all_parameters);
        }
      log_file.open(file("log.txt"), /* keep */ resume);
      log_file.append(early_lines);
    });
    early_lines.clear();
  }



  void
  RunFolder::log(const std::string &line)
  {
    if (is_root && !options.quiet)
      std::cout << line << std::endl;
    if (!begun)
      early_lines += line + "\n";
    else
      on_first_rank(communicator, [&]() { log_file.append(line + "\n"); });
  }



  std::string
  RunFolder::file(const std::string &name) const
  {
    return (std::filesystem::path(options.path) / name).string();
  }
} // namespace Ricochet
