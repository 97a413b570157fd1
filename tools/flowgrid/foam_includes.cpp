#include "foam_includes.h"

#include "input_parts.h"

#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace flowgrid {

namespace {

  [[noreturn]] void stop(const std::string &file, const std::string &why)
  {
    throw std::runtime_error(file + ": " + why);
  }

  bool is_one_of(char c, std::string_view all)
  {
    return all.find(c) != std::string_view::npos;
  }

  // Words as VTK takes them out of a file.
  class Words {
   public:
    struct Cut {};    // the text ends before a word does

    explicit Words(std::string_view text) : text(text) {}

    // a word or what stands in quotes; empty for anything else
    std::string next()
    {
      skip_white();
      if (peek() == '"') return quoted();
      if (is_one_of(peek(), "(){}[];:,=+*/#$-.0123456789")) return {};
      std::string word;
      for (int open = 0; !is_one_of(peek(), white) && !is_one_of(peek(), "\"/;{}"); at++) {
        open += peek() == '(' ? 1 : peek() == ')' ? -1 : 0;
        if (open < 0) break;
        word += peek();
        if (word.size() == longest) return {};
      }
      return word.substr(0, word.find('\0'));    // VTK takes them up to the first 0, too
    }

   private:
    static constexpr std::string_view white = " \t\r\n\v\f";
    static constexpr std::size_t longest = 1024;    // which VTK refuses
    std::string_view text;
    std::size_t at = 0;

    char peek(std::size_t on = 0) const
    {
      if (at + on >= text.size()) throw Cut();
      return text[at + on];
    }
    void skip_beyond(std::string_view end)
    {
      const auto found = text.find(end, at);
      if (found == std::string_view::npos) throw Cut();
      at = found + end.size();
    }
    void skip_white()
    {
      for (;;)
        if (is_one_of(peek(), white))
          at++;
        else if (peek() == '/' && peek(1) == '/')
          skip_beyond("\n");
        else if (peek() == '/' && peek(1) == '*') {
          at += 2;
          skip_beyond("*/");
        } else
          return;
    }
    std::string quoted()
    {
      std::string word;
      for (at++; peek() != '"'; at++) {
        if (peek() == '\\') at++;
        word += peek();
        if (word.size() == longest) return {};
      }
      at++;
      return word.substr(0, word.find('\0'));
    }
  };

  // Names that a file includes, compressed or not. Numbers may be written in bytes, so that any
  // byte may be a #: what follows each is looked at. is_included: where this file ends, the one
  // that includes it goes on.
  std::vector<std::string> names_included_in(const std::string &path, bool is_included)
  {
    constexpr std::size_t part = std::size_t(4) << 20, reach = std::size_t(1) << 20;
    const std::string unclear = "has an #include without a plain name: it is not read";
    std::vector<std::string> names;
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(path.c_str(), "rb"), gzclose);
    if (!in) return names;    // nor does VTK read it
    std::string text;
    for (bool more = true; more;) {
      const std::size_t before = text.size();
      text.resize(before + part);
      const int read = gzread(in.get(), text.data() + before, part);
      more = read > 0;
      text.resize(before + std::max(read, 0));
      std::size_t at = 0;
      for (; (at = text.find('#', at)) != std::string::npos; at++) {
        if (more && text.size() - at < reach) break;
        try {
          Words words(std::string_view(text).substr(at + 1));
          const auto directive = words.next();
          if (directive != "include" && directive != "sinclude" && directive != "includeIfPresent")
            continue;
          names.push_back(words.next());
          if (names.back().empty()) stop(path, unclear);
        } catch (const Words::Cut &) {
          if (more || is_included) stop(path, unclear);
        }
      }
      text.erase(0, std::min(at, text.size()));
    }
    return names;
  }

  class Case {
   public:
    explicit Case(const fs::path &folder) : home(folder), real_home(fs::canonical(folder)) {}

    void check()
    {
      const auto options = fs::directory_options::follow_directory_symlink |
          fs::directory_options::skip_permission_denied;
      std::error_code failed, none;
      fs::recursive_directory_iterator it(home, options, failed);
      for (; !failed && it != fs::end(it); it.increment(failed)) {
        if (it->is_directory(none)) {
          // the same folder again, by a link
          if (!folders.insert(fs::canonical(it->path(), none)).second)
            it.disable_recursion_pending();
        } else if (it->is_regular_file(none) && is_read(it->path().lexically_relative(home)))
          follow(it->path(), false);
      }
    }

   private:
    const fs::path home, real_home;
    std::set<fs::path> folders;
    std::set<std::pair<fs::path, bool>> known;

    // Mesh and properties, times, and the file that says which times there are.
    static bool is_read(const fs::path &inside)
    {
      const std::string first = inside.begin()->string();
      return first == "constant" || inside == "system/controlDict" ||
          inside == "system/controlDict.gz" ||
          first.find_first_not_of("0123456789+-.eE") == std::string::npos;
    }

    void follow(const fs::path &file, bool is_included)
    {
      const auto self = fs::weakly_canonical(file.parent_path()) / file.filename();
      if (!known.insert({self, is_included}).second) return;
      for (const auto &name : names_included_in(file, is_included)) {
        const fs::path other = place_of(file, name);
        std::error_code none;
        const auto status = fs::status(other, none);
        if (!fs::exists(status)) continue;
        if (!fs::is_regular_file(status))
          stop(file, "includes " + name + ", which is not a regular file: it is not read");
        follow(other, true);
      }
    }

    // Where VTK looks for it, if that is in the case. A link in the case is followed.
    fs::path place_of(const fs::path &file, const std::string &name) const
    {
      const std::string of_case = "$FOAM_CASE/";
      const bool begins = name.compare(0, of_case.size(), of_case) == 0;
      const std::string rest = begins ? name.substr(of_case.size()) : name;
      fs::path other = (begins ? home : file.parent_path()) / rest;
      const auto real = fs::weakly_canonical(other);
      const bool inside =
          std::mismatch(real_home.begin(), real_home.end(), real.begin(), real.end()).first ==
          real_home.end();
      if (rest.find_first_of("$~\\") != std::string::npos || (!is_below(rest) && !inside))
        stop(file, "includes " + name + ", which is not in the folder of the case: it is not read");
      return other;
    }
  };

}    // namespace

void check_includes(const std::string &folder)
{
  Case(folder).check();
}

}    // namespace flowgrid
