// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_named_table_h
#define ricochet_base_named_table_h

#include <base/own_parameter.h>

#include <deal.II/base/exceptions.h>

#include <string>
#include <utility>
#include <vector>

namespace Ricochet
{
  /// The name of an entry of a NamedTable, where it is its member; other entries have an
  /// overload.
  template <typename Entry>
  const std::string &
  name_of(const Entry &entry)
  {
    return entry.name;
  }

  /// A table from which parameter files choose by name, and to which programs may add.
  /// Entries have a name and `parameters`.
  template <typename Entry>
  class NamedTable
  {
  public:
    /// @param article and @param kind of the entries, for messages: "a", "time scheme".
    NamedTable(std::string        article,
               std::string        kind,
               std::vector<Entry> entries)
      : article(std::move(article))
      , kind(std::move(kind))
      , entries(std::move(entries))
    {}

    /// @throws dealii::ExcMessage when its name is taken.
    void
    add(const Entry &entry)
    {
      for (const Entry &other : entries)
        AssertThrow(name_of(other) != name_of(entry),
                    dealii::ExcMessage("There is " + article + " " + kind +
                                       " '" + name_of(entry) + "' already."));
      entries.push_back(entry);
    }

    /// @throws dealii::ExcMessage when there is none with this @p name.
    const Entry &
    operator[](const std::string &name) const
    {
      for (const Entry &entry : entries)
        if (name_of(entry) == name)
          return entry;
      AssertThrow(false, dealii::ExcMessage("unknown " + kind + " " + name));
      return entries.front();
    }

    /// All names, for a dealii::Patterns::Selection.
    std::string
    names() const
    {
      std::string list;
      for (const Entry &entry : entries)
        list += (list.empty() ? "" : "|") + name_of(entry);
      return list;
    }

    /// The parameters of all entries.
    OwnParameters
    parameters() const
    {
      OwnParameters all;
      for (const Entry &entry : entries)
        unite(all, entry.parameters);
      return all;
    }

    unsigned int
    size() const
    {
      return entries.size();
    }

    auto
    begin() const
    {
      return entries.begin();
    }

    auto
    end() const
    {
      return entries.end();
    }

  private:
    const std::string  article, kind;
    std::vector<Entry> entries;
  };
} // namespace Ricochet

#endif
