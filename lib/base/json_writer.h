// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_json_writer_h
#define ricochet_base_json_writer_h

#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace Ricochet
{
  /// A JSON text (RFC 8259) that is one object, written member by member.
  class JsonWriter
  {
  public:
    /// @param on_one_line without line breaks, for files with an object on each line.
    explicit JsonWriter(const bool on_one_line = false)
      : on_one_line(on_one_line)
    {}

    /// Members up to end_object() belong to the member @p name.
    void
    begin_object(const std::string &name)
    {
      begin_member(name);
      text += "{";
      is_empty = true;
      ++depth;
    }

    void
    end_object()
    {
      --depth;
      if (!is_empty)
        begin_line();
      text += "}";
      is_empty = false;
    }

    void
    add(const std::string &name, const std::string &value)
    {
      begin_member(name);
      text += quoted(value);
    }

    void
    add(const std::string &name, const char *value)
    {
      add(name, std::string(value));
    }

    void
    add(const std::string &name, const bool value)
    {
      begin_member(name);
      text += value ? "true" : "false";
    }

    void
    add(const std::string &name, const unsigned int value)
    {
      begin_member(name);
      text += std::to_string(value);
    }

    /// null where @p value is not finite, which JSON has no word for; otherwise so many digits
    /// that a reader gets the same double.
    void
    add(const std::string &name, const double value)
    {
      begin_member(name);
      write(value);
    }

    void
    add(const std::string &name, const std::vector<double> &values)
    {
      begin_member(name);
      text += "[";
      for (unsigned int k = 0; k < values.size(); ++k)
        {
          text += k == 0 ? "" : ", ";
          write(values[k]);
        }
      text += "]";
    }

    void
    add_null(const std::string &name)
    {
      begin_member(name);
      text += "null";
    }

    void
    add(const std::string &name, const std::vector<std::string> &values)
    {
      begin_member(name);
      text += "[";
      for (unsigned int k = 0; k < values.size(); ++k)
        text += (k == 0 ? "" : ", ") + quoted(values[k]);
      text += "]";
    }

    /// The whole text. @pre each object has ended.
    std::string
    finished() const
    {
      return text + (on_one_line ? "}\n" : "\n}\n");
    }

  private:
    void
    write(const double value)
    {
      if (!std::isfinite(value))
        {
          text += "null";
          return;
        }
      // Locales write other decimal points.
      char number[32];
      text.append(number,
                  std::to_chars(number, number + sizeof(number), value).ptr);
    }

    void
    begin_line()
    {
      if (!on_one_line)
        text += "\n" + std::string(2 * depth, ' ');
    }

    void
    begin_member(const std::string &name)
    {
      if (!is_empty)
        text += ",";
      is_empty = false;
      begin_line();
      text += quoted(name) + ": ";
    }

    static std::string
    quoted(const std::string &value)
    {
      std::string result = "\"";
      for (const char c : value)
        if (c == '"' || c == '\\')
          result += std::string("\\") + c;
        else if (static_cast<unsigned char>(c) < 0x20)
          {
            char code[8];
            std::snprintf(code, sizeof(code), "\\u%04x", c);
            result += code;
          }
        else
          result += c;
      return result + "\"";
    }

    const bool   on_one_line;
    std::string  text     = "{";
    unsigned int depth    = 1;
    bool         is_empty = true;
  };
} // namespace Ricochet

#endif
