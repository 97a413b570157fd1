#include "read_guard.h"

#include <csignal>
#include <ctime>

#ifndef _WIN32
#include <unistd.h>
#endif

namespace LAMMPS_NS {

#ifdef _WIN32

ReadGuard::ReadGuard(const std::string &, std::size_t) {}
ReadGuard::~ReadGuard() {}

#else

namespace {

  // Time of the processor until HDF5 is held to read on without an end. Compressed
  // numbers, the slowest, take 5e-8 s each.
  constexpr double seconds = 20.0, seconds_per_number = 1e-5;

  constexpr int signals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU};
  struct sigaction before[6];
  stack_t stack_before;
  char stack[1 << 16];    // a stack that overflowed has no room for the handler
  std::string crash_line, time_line;

#if defined(_POSIX_TIMERS) && _POSIX_TIMERS > 0 && defined(_POSIX_THREAD_CPUTIME)

  timer_t timer;
  bool timed = false;

  void begin_timer(double time)
  {
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGXCPU;
    event.sigev_value.sival_ptr = &timer;
    timed = timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &timer) == 0;
    itimerspec until{};
    until.it_value.tv_sec = static_cast<time_t>(time);
    if (timed) timer_settime(timer, 0, &until, nullptr);
  }
  void end_timer()
  {
    if (timed) timer_delete(timer);
  }
  // a limit of the program's time sends the same signal
  bool is_timer(int signal, const siginfo_t *info)
  {
    return signal == SIGXCPU && info->si_code == SI_TIMER && info->si_value.sival_ptr == &timer;
  }

#else    // as on macOS: no such timers

  void begin_timer(double) {}
  void end_timer() {}
  bool is_timer(int, const siginfo_t *)
  {
    return false;
  }

#endif

  // only what may be called within a handler of signals
  void say(const std::string &line)
  {
    const auto written = write(2, line.data(), line.size());
    if (written < 0) _exit(1);
  }

  void answer(int signal, siginfo_t *info, void *)
  {
    if (is_timer(signal, info)) {
      say(time_line);
      _exit(1);
    }
    if (signal != SIGXCPU) say(crash_line);
    for (int k = 0; k < 6; k++)
      if (signals[k] == signal) sigaction(signal, &before[k], nullptr);
    // what the processor itself refused is tried again, so that the next one sees where it was
    if (info->si_code <= 0 || signal == SIGXCPU) raise(signal);
  }

}    // namespace

/* ---------------------------------------------------------------------- */

ReadGuard::ReadGuard(const std::string &what, std::size_t numbers)
{
  crash_line = "ERROR: " + what + ": HDF5 crashes while it reads this file, which is damaged\n";
  time_line = "ERROR: " + what +
      ": HDF5 works on this file for far longer than its size is worth; it is damaged\n";
  stack_t other{};
  other.ss_sp = stack;
  other.ss_size = sizeof(stack);
  sigaltstack(&other, &stack_before);
  struct sigaction action {};
  action.sa_sigaction = answer;
  action.sa_flags = SA_ONSTACK | SA_SIGINFO;
  for (int k = 0; k < 6; k++) sigaction(signals[k], &action, &before[k]);
  begin_timer(seconds + seconds_per_number * static_cast<double>(numbers));
}

/* ---------------------------------------------------------------------- */

ReadGuard::~ReadGuard()
{
  end_timer();
  for (int k = 0; k < 6; k++) sigaction(signals[k], &before[k], nullptr);
  sigaltstack(&stack_before, nullptr);
}

#endif

}    // namespace LAMMPS_NS
