// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/field_list.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// A file of fields that was written to its end.
    bool
    is_whole(const std::string &file)
    {
      constexpr std::streamoff length = 40;
      std::ifstream            in(file, std::ios::binary | std::ios::ate);
      if (!in || in.tellg() < length)
        return false;
      std::string end(length, '\0');
      in.seekg(-length, std::ios::end);
      in.read(end.data(), length);
      return end.find("</VTKFile>") != std::string::npos;
    }

    std::string
    list_of(const std::vector<std::pair<double, std::string>> &times_and_files)
    {
      std::ostringstream text;
      DataOutBase::write_pvd_record(text, times_and_files);
      return text.str();
    }

    /// Read the @p number at the beginning of @p text. @return whether there is one.
    template <typename Number>
    bool
    read(const std::string &text, Number &number)
    {
      const char *const end = text.data() + text.size();
      return std::from_chars(text.data(), end, number).ec == std::errc();
    }
  } // namespace



  FieldList::FieldList(RunFolder         &folder,
                       const std::string &name,
                       const std::string &files)
    : folder(folder)
    , name(name)
    , files(files)
  {
    if (!folder.resume || !std::filesystem::exists(folder.file(name)))
      return;
    std::istringstream in(read_file(folder.file(name)));
    std::string        line;
    const std::regex   entry("timestep=\"([^\"]*)\".*file=\"" + files +
                           "([0-9]*)\\.vtu\"");
    std::smatch        match;
    while (std::getline(in, line))
      if (std::regex_search(line, match, entry))
        {
          unsigned int step = 0;
          double       time = 0.;
          if (read(match[2], step) && read(match[1], time) &&
              is_whole(folder.file(file_of(step))))
            times[step] = time;
          else
            folder.log(
              "note: '" + files + match[2].str() +
              ".vtu' is missing or damaged and is not listed any more");
        }
  }



  std::string
  FieldList::file_of(const unsigned int step) const
  {
    return files + Utilities::int_to_string(step, 6) + ".vtu";
  }



  void
  FieldList::append(const unsigned int step, const double time)
  {
    const bool is_last = times.empty() || times.rbegin()->first < step;
    times.erase(times.lower_bound(step), times.end());
    times[step] = time;
    on_first_rank(folder.communicator, [&]() {
      if (is_written && is_last)
        {
          const std::string list  = list_of({{time, file_of(step)}});
          const std::size_t entry = list.find("    <DataSet"),
                            end   = list.find("  </Collection>");
          if (replace_end(folder.file(name),
                          list.substr(end),
                          list.substr(entry)))
            return;
        }
      std::vector<std::pair<double, std::string>> times_and_files;
      for (const auto &[number, its_time] : times)
        times_and_files.emplace_back(its_time, file_of(number));
      write_atomically(folder.file(name), list_of(times_and_files));
    });
    is_written = true;
  }
} // namespace Ricochet
