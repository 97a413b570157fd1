// One input in a child process of its own: crashes, hangs and huge allocations are seen from
// outside.

#ifndef APF_FUZZ_CHILD_H
#define APF_FUZZ_CHILD_H

#include <csignal>
#include <cstring>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fuzz {

#ifdef __SANITIZE_ADDRESS__
constexpr bool memory_is_bounded = false;    // the sanitizer's own is larger than any bound
#else
constexpr bool memory_is_bounded = true;
#endif

// How a child ended: what it wrote, and its status or what killed it.
struct Ended {
  std::string death, text;
  int status = 0;
};

// work: given where to write, returns the status.
//   seconds: of the processor, which a busy machine does not take away; bytes: of memory
template <class Work> Ended in_child(const Work &work, rlim_t seconds, rlim_t bytes)
{
  int ends[2];
  if (pipe(ends) != 0) return {"no pipe", ""};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    const rlimit memory = {bytes, bytes}, time = {seconds, seconds + 5};
    if (memory_is_bounded) setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CPU, &time);
    alarm(static_cast<unsigned>(30 * seconds));    // of the clock: it may wait for what never comes
    _exit(work(ends[1]));
  }
  close(ends[1]);
  Ended ended;
  char part[4096];
  for (ssize_t n; (n = read(ends[0], part, sizeof(part))) > 0;) ended.text.append(part, n);
  close(ends[0]);
  int status;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    ended.death = signal == SIGALRM || signal == SIGXCPU
        ? "hang: over " + std::to_string(seconds) + " s"
        : std::string("crash: ") + strsignal(signal);
  } else
    ended.status = WEXITSTATUS(status);
  return ended;
}

struct Outcome {
  enum Kind { ACCEPTED, REFUSED, FAILED } kind;
  std::string text;
};

}    // namespace fuzz

#endif
