// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/xdmf_list.h>

#include <deal.II/base/utilities.h>

#include <filesystem>
#include <regex>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    const std::string head =
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n"
      "    <Grid Name=\"CellTime\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
    const std::string foot       = "    </Grid>\n  </Domain>\n</Xdmf>\n";
    const std::string end_of_one = "</Grid>\n";
  } // namespace



  std::vector<std::string>
  XdmfList::read(const std::string &file)
  {
    std::vector<std::string> entries;
    if (!std::filesystem::exists(file))
      return entries;
    const std::string text = read_file(file);
    if (text.compare(0, head.size(), head) != 0)
      return entries;
    for (std::size_t begin = head.size(), end;
         (end = text.find(end_of_one, begin)) != std::string::npos;
         begin = end + end_of_one.size())
      entries.push_back(text.substr(begin, end + end_of_one.size() - begin));
    // The end of the list itself.
    if (!entries.empty() && entries.back().find("<Time") == std::string::npos)
      entries.pop_back();
    return entries;
  }



  std::string
  XdmfList::text_of(const std::vector<std::string> &entries)
  {
    std::string text = head;
    for (const std::string &entry : entries)
      text += entry;
    return text + foot;
  }



  XdmfList::XdmfList(RunFolder &folder)
    : folder(folder)
  {
    if (!folder.is_root || !folder.resume)
      return;
    const std::regex file("solution/step-([0-9]{6,9})\\.h5:");
    std::smatch      match;
    for (const std::string &entry : read(folder.file(name)))
      if (std::regex_search(entry, match, file) &&
          std::filesystem::exists(folder.file(file_of(std::stoul(match[1])))))
        entries[std::stoul(match[1])] = entry;
  }



  std::string
  XdmfList::file_of(const unsigned int step)
  {
    return "solution/step-" + Utilities::int_to_string(step, 6) + ".h5";
  }



  void
  XdmfList::append(const unsigned int step, const std::string &entry)
  {
    on_first_rank(folder.communicator, [&]() {
      const bool is_last = entries.empty() || entries.rbegin()->first < step;
      entries.erase(entries.lower_bound(step), entries.end());
      entries[step] = entry;
      if (is_written && is_last &&
          replace_end(folder.file(name), foot, entry + foot))
        return;
      std::vector<std::string> all;
      for (const auto &[number, its_entry] : entries)
        all.push_back(its_entry);
      write_atomically(folder.file(name), text_of(all));
    });
    is_written = true;
  }
} // namespace Ricochet
