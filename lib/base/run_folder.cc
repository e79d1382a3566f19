// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/json_writer.h>
#include <base/run_folder.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <regex>
#include <sstream>
#include <vector>

namespace Ricochet
{
  namespace
  {
    // Names of the files that a run leaves in its folder.
    const std::string identity_file                = "run.txt";
    const std::string checkpoint_file              = "checkpoint.bin";
    const std::string all_values                   = "parameters.prm";
    const std::string all_values_of_resumed        = "parameters.resumed.prm";
    const std::vector<std::string> lists_of_fields = {"solution.pvd",
                                                      "obstacles.pvd",
                                                      "solution.xdmf"};
    const std::vector<std::string> result_files    = {checkpoint_file,
                                                      "energy.csv",
                                                      "energy.h5",
                                                      lists_of_fields[0],
                                                      lists_of_fields[1],
                                                      lists_of_fields[2],
                                                      "certificate.json",
                                                      "log.txt",
                                                      "summary.json",
                                                      all_values,
                                                      all_values_of_resumed};

    // A finished run that was not resumed in between can be repeated.
    const std::string complete = "complete", resumed = "resumed",
                      running = "running";

    /// The name of the copy of a parameter file in the folder.
    std::string
    name_of_copy(const std::string &parameter_file)
    {
      return std::filesystem::path(parameter_file).filename().string();
    }

    /// The files of fields that a list of them names and that have names such as ours.
    std::vector<std::string>
    fields_of(const std::string &list)
    {
      static const std::regex entry(
        "[\">\\s](solution/(step|obstacles)-[0-9]+\\.(vtu|h5))[\":]");
      std::vector<std::string> names;
      for (std::sregex_iterator match(list.begin(), list.end(), entry), end;
           match != end;
           ++match)
        names.push_back((*match)[1]);
      return names;
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
      const auto      refuse_to_resume_nothing = [&]() {
        if (resume && !exists(file(checkpoint_file)))
          throw InputError("The run cannot be resumed: the checkpoint '" +
                           file(checkpoint_file) + "' does not exist.");
      };
      if (!exists(options.path))
        refuse_to_resume_nothing();
      fs::create_directories(options.path, error);
      if (error)
        throw InputError("The output folder '" + options.path +
                         "' cannot be written to: " + error.message() + ".");
      const std::string note = lock.take(options.path);
      if (!note.empty())
        this->log(note);
      refuse_to_resume_nothing();
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
  RunFolder::check_parameter_file() const
  {
    std::vector<std::string> names = result_files;
    names.push_back(identity_file);
    for (const std::string &name : names)
      {
        // All values of a run may be run again where they are.
        const bool is_kept =
          name == (resume ? all_values : all_values_of_resumed) ||
          !same_file(file(name), options.parameter_file) ||
          read_file(options.parameter_file) == all_parameters;
        if (!is_kept)
          throw InputError("The parameter file '" + options.parameter_file +
                           "' has the name of a file that the run writes to "
                           "its folder. Copy it to another name first.");
      }
  }



  bool
  RunFolder::has_copy() const
  {
    const std::string name = name_of_copy(options.parameter_file);
    return !name.empty() && name != identity_file &&
      std::find(result_files.begin(), result_files.end(), name) ==
      result_files.end() &&
      !same_file(file(name), options.parameter_file);
  }



  void
  RunFolder::check_whose_run_it_holds() const
  {
    const auto refuse = [&](const std::string &whose) {
      throw InputError("The output folder '" + options.path +
                       "' holds the results of " + whose +
                       ". Name another folder with --output-dir, or "
                       "replace them with --overwrite.");
    };
    if (!exists(file(identity_file)))
      {
        for (const std::string &name : result_files)
          if (exists(file(name)))
            refuse("an unknown run");
        std::error_code error;
        if (!std::filesystem::is_empty(file("solution"), error) && !error)
          refuse("an unknown run, with files in 'solution'");
        const std::string copy = name_of_copy(options.parameter_file);
        if (has_copy() && exists(file(copy)) &&
            read_file(file(copy)) != read_file(options.parameter_file))
          refuse("others: '" + copy + "' is not the file that was given");
        return;
      }
    const std::string found   = read_file(file(identity_file));
    const std::string program = entry(found, "program = ");
    const std::string other   = entry(found, "parameter file = ");
    // A file that was moved, or came with the folder from elsewhere, is still
    // the same file.
    const bool is_moved = program == options.program && !other.empty() &&
      !options.parameter_file.empty() &&
      name_of_copy(other) == name_of_copy(options.parameter_file) &&
      exists(file(name_of_copy(other))) &&
      read_file(file(name_of_copy(other))) == read_file(options.parameter_file);
    if (found.compare(0, identity.size(), identity) != 0 && !is_moved)
      refuse(program +
             (other.empty() ? " without a parameter file" : " with " + other));
    const std::string state = entry(found, "state = ");
    if (state != complete && exists(file(checkpoint_file)))
      throw InputError(
        "The output folder '" + options.path + "' holds a run of this " +
        (options.parameter_file.empty() ? "program" : "file") + " that " +
        (state == resumed ? "was resumed" : "did not come to its end") +
        " and has a checkpoint. Go on with it with --resume, name another folder "
        "with --output-dir, or replace it with --overwrite.");
  }



  void
  RunFolder::remove_earlier_results() const
  {
    namespace fs = std::filesystem;
    // The checkpoint first: from then on nothing can be resumed by mistake.
    std::vector<std::string> names = result_files;
    static const std::regex  mesh(name_of_mesh("[A-Za-z0-9._-]+"));
    for (const auto &one : fs::directory_iterator(options.path))
      if (std::regex_match(one.path().filename().string(), mesh))
        names.push_back(one.path().filename().string());
    std::error_code         no_folder;
    static const std::regex contact("step-[0-9]{6,}\\.h5");
    for (const auto &one : fs::directory_iterator(file("contact"), no_folder))
      if (const std::string name = one.path().filename().string();
          std::regex_match(name, contact))
        names.push_back("contact/" + name);
    for (const std::string &list : lists_of_fields)
      if (exists(file(list)))
        for (const std::string &name : fields_of(read_file(file(list))))
          names.push_back(name);
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
        // Files left by a run that was killed.
        fs::remove(file(name) + unfinished, error);
      }
  }



  void
  RunFolder::write_identity(const std::string &state) const
  {
    std::string whose = identity;
    if (resume && exists(file(identity_file)))
      {
        whose = read_file(file(identity_file));
        whose.erase(std::min(whose.size(), whose.find("state = ")));
      }
    write_atomically(file(identity_file), whose + "state = " + state + "\n");
  }



  void
  RunFolder::begin()
  {
    if (begun)
      return;
    begun = true;
    on_first_rank(communicator, [&]() {
      check_parameter_file();
      if (resume)
        {
          // An attempt to resume with other parameters must not overwrite the
          // ones that the results in the folder belong to.
          write_atomically(file(all_values_of_resumed), all_parameters);
          write_identity(resumed);
        }
      else
        {
          remove_earlier_results();
          write_identity(running);
          const std::string &given = options.parameter_file;
          if (has_copy())
            write_atomically(file(name_of_copy(given)), read_file(given));
          write_atomically(file(all_values), all_parameters);
        }
      log_file.open(file("log.txt"), /* keep */ resume);
      log_file.append(early_lines);
    });
    early_lines.clear();
  }



  void
  RunFolder::end()
  {
    if (!resume)
      on_first_rank(communicator, [&]() { write_identity(complete); });
  }



  void
  RunFolder::log(const std::string &line)
  {
    if (is_root && !options.quiet && !options.json_progress)
      std::cout << line << std::endl;
    if (!begun)
      early_lines += line + "\n";
    else
      on_first_rank(communicator, [&]() { log_file.append(line + "\n"); });
  }



  void
  RunFolder::report_progress(const JsonWriter &json) const
  {
    if (is_root && options.json_progress)
      std::cout << json.finished() << std::flush;
  }



  std::string
  RunFolder::name_of_mesh(const std::string &body)
  {
    return "mesh_of_" + body + ".msh";
  }



  bool
  RunFolder::has_checkpoint(const std::string &path)
  {
    return exists((std::filesystem::path(path) / checkpoint_file).string());
  }



  std::string
  RunFolder::file(const std::string &name) const
  {
    return (std::filesystem::path(options.path) / name).string();
  }
} // namespace Ricochet
