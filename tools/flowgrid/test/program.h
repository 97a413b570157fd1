// Runs the program in a folder of its own.

#ifndef FLOWGRID_TEST_PROGRAM_H
#define FLOWGRID_TEST_PROGRAM_H

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <pty.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace flowgrid {

namespace fs = std::filesystem;

// icoFoam's result between two walls
inline const std::string poiseuille = std::string(FLOWGRID_DATA) + "/poiseuille";

// a folder that goes when the test ends
struct Folder {
  fs::path path = fs::temp_directory_path() / ("flowgrid-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const std::string &name) const { return (path / name).string(); }
};

struct Result {
  int status;
  std::string text;
};
// before: what the shell does first
inline Result flowgrid_with(const std::string &words, const std::string &before = "")
{
  FILE *pipe = popen((before + " exec " + FLOWGRID + " " + words + " 2>&1").c_str(), "r");
  std::string text;
  char line[512];
  while (fgets(line, sizeof(line), pipe)) text += line;
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

// the same on a terminal
inline Result flowgrid_on_terminal(const std::string &words)
{
  int terminal;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execl("/bin/sh", "sh", "-c", (std::string(FLOWGRID) + " " + words).c_str(), nullptr);
    _exit(127);
  }
  std::string text;
  char part[512];
  for (ssize_t n; (n = read(terminal, part, sizeof(part))) > 0;) text.append(part, n);
  int status;
  waitpid(child, &status, 0);
  close(terminal);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text};
}

}    // namespace flowgrid

#endif
