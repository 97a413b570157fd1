#include "crash_line.h"

using namespace LAMMPS_NS;

#ifdef _WIN32

CrashLine::CrashLine(const std::string &) {}
CrashLine::~CrashLine() {}

#else

#include <csignal>
#include <unistd.h>

namespace {

constexpr int signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
struct sigaction before[5];
stack_t stack_before;
char stack[1 << 16];    // a stack that overflowed has no room for the handler
std::string line;

// only what may be called within a handler of signals
void answer(int signal)
{
  const auto written = write(2, line.data(), line.size());
  if (written < 0) _exit(1);
  for (int k = 0; k < 5; k++)
    if (signals[k] == signal) sigaction(signal, &before[k], nullptr);
  raise(signal);
}

}    // namespace

/* ---------------------------------------------------------------------- */

CrashLine::CrashLine(const std::string &text)
{
  line = "ERROR: " + text + "\n";
  stack_t other{};
  other.ss_sp = stack;
  other.ss_size = sizeof(stack);
  sigaltstack(&other, &stack_before);
  struct sigaction action {};
  action.sa_handler = answer;
  action.sa_flags = SA_ONSTACK;
  for (int k = 0; k < 5; k++) sigaction(signals[k], &action, &before[k]);
}

/* ---------------------------------------------------------------------- */

CrashLine::~CrashLine()
{
  for (int k = 0; k < 5; k++) sigaction(signals[k], &before[k], nullptr);
  sigaltstack(&stack_before, nullptr);
}

#endif
