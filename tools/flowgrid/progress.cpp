#include "progress.h"

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace flowgrid {

namespace {

  const bool terminal = isatty(STDERR_FILENO);
  std::string shown_stage;
  int shown = -1;    // percent

}    // namespace

void show_progress(const std::string &stage, double share_done)
{
  if (!terminal) return;
  const int percent = static_cast<int>(100.0 * std::clamp(share_done, 0.0, 1.0));
  if (percent == shown && stage == shown_stage) return;
  shown = percent;
  shown_stage = stage;
  const std::string bar(percent * 40 / 100, '#');
  fprintf(stderr, "\r%-8s %3d %% [%-40s]", stage.c_str(), percent, bar.c_str());
}

void end_progress()
{
  if (shown < 0) return;
  shown = -1;
  fputs("\r\033[K", stderr);
}

}    // namespace flowgrid
