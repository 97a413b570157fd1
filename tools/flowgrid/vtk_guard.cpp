#include "vtk_guard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <unistd.h>

namespace flowgrid {

namespace {

  const char *volatile file_read = nullptr;

  void say(const char *text)
  {
    const auto written = write(2, text, std::strlen(text));
    if (written < 0) _exit(1);
  }

  // only what may be called within a handler of signals
  void name_file(const char *what)
  {
    if (!file_read) return;
    say("flowgrid: ");
    say(file_read);
    say(what);
    _exit(1);
  }
  void name_file()
  {
    name_file(
        ": VTK failed while it read this file, which is damaged or of a kind that VTK does not "
        "know\n");
  }
  void answer_time(int)
  {
    name_file(": VTK works on this file for far longer than its size is worth; it is damaged\n");
  }
  void answer(int signal)
  {
    name_file();
    raise(signal);    // of its own default by now
  }

  [[noreturn]] void stop(const std::string &file, const std::string &why)
  {
    throw std::runtime_error(file + ": " + why);
  }

  // corners of a cell of VTK's type, 0 if its number is its own
  vtkIdType corners_of(int type)
  {
    switch (type) {
      case VTK_VERTEX:
        return 1;
      case VTK_LINE:
        return 2;
      case VTK_TRIANGLE:
        return 3;
      case VTK_QUAD:
      case VTK_PIXEL:
      case VTK_TETRA:
        return 4;
      case VTK_PYRAMID:
        return 5;
      case VTK_WEDGE:
        return 6;
      case VTK_HEXAHEDRON:
      case VTK_VOXEL:
        return 8;
      default:
        return 0;
    }
  }

  std::string whole(double a)
  {
    char text[400];
    std::snprintf(text, sizeof(text), "%.0f", a);
    return text;
  }

  // VTK reads lists of corners as they are in the file and follows them.
  void check_corners(const std::string &file, vtkCellArray *cells, vtkIdType npoints)
  {
    auto *begins = cells->GetOffsetsArray(), *corners = cells->GetConnectivityArray();
    const vtkIdType count = corners->GetNumberOfValues();
    double last = 0.0;
    for (vtkIdType c = 0; c < begins->GetNumberOfValues(); c++) {
      const double begin = begins->GetComponent(c, 0);
      if (!(begin >= last && begin <= static_cast<double>(count)))
        stop(file, "cell " + std::to_string(c) + " begins outside of the list of corners");
      last = begin;
    }
    for (vtkIdType k = 0; k < count; k++) {
      const double point = corners->GetComponent(k, 0);
      if (!(point >= 0.0 && point < static_cast<double>(npoints)))
        stop(file,
             "a cell has point " + whole(point) + ", but there are " + std::to_string(npoints) +
                 " points");
    }
  }

  // Memory for that many bytes of files: zlib makes no more than 1032 bytes of one.
  rlim_t memory_for(double bytes)
  {
    return bytes < 1e15 ? (rlim_t(4) << 30) + 1032 * static_cast<rlim_t>(bytes) : RLIM_INFINITY;
  }

  // Of the clock that counts all time of the processor. ITIMER_PROF counts what ticks of the kernel
  // happen to see, half as much where a program often waits.
  timer_t timer;

  // Time of the processor until VTK is held to hang: 50 kbytes a second, where it reads a hundred
  // times as many.
  void begin_timer(double bytes)
  {
    itimerspec time{};
    time.it_value.tv_sec = std::isfinite(bytes) ? static_cast<time_t>(20.0 + bytes / 5e4) : 0;
    timer_settime(timer, 0, &time, nullptr);
  }

}    // namespace

ReadByVtk::ReadByVtk(const std::string &file) : name_before(file_read), limit_before(RLIM_INFINITY)
{
  rlimit memory{};
  getrlimit(RLIMIT_DATA, &memory);
  limit_before = memory.rlim_cur;
  file_read = file.c_str();
  std::error_code none;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file, none));
  if (limit_before != RLIM_INFINITY && !name_before) begin_timer(none ? INFINITY : bytes);
}

void ReadByVtk::limit_for(double bytes) const
{
  if (limit_before == RLIM_INFINITY) return;    // without guard_against_files(): fuzzers
  rlimit memory{};
  getrlimit(RLIMIT_DATA, &memory);
  memory.rlim_cur = std::min(limit_before, memory_for(bytes));
  setrlimit(RLIMIT_DATA, &memory);
  if (!name_before) begin_timer(bytes);
}

ReadByVtk::~ReadByVtk()
{
  file_read = name_before;
  if (limit_before == RLIM_INFINITY) return;
  if (!name_before) begin_timer(INFINITY);
  rlimit memory{};
  getrlimit(RLIMIT_DATA, &memory);
  memory.rlim_cur = limit_before;
  setrlimit(RLIMIT_DATA, &memory);
}

void check_cells(const std::string &file, vtkDataSet *set)
{
  const vtkIdType npoints = set->GetNumberOfPoints();
  if (auto *surface = vtkPolyData::SafeDownCast(set))
    for (auto *cells :
         {surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips()})
      check_corners(file, cells, npoints);
  auto *grid = vtkUnstructuredGrid::SafeDownCast(set);
  if (!grid && set->GetNumberOfCells() > 0 && !set->GetCell(0))
    stop(file, "says that it has cells, but has none");
  if (!grid || !grid->GetCells()) return;
  check_corners(file, grid->GetCells(), npoints);
  std::array<bool, 256> known{};
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); c++) {
    const int type = grid->GetCellType(c);
    const auto expected = corners_of(type);
    if (expected && grid->GetCells()->GetCellSize(c) != expected)
      stop(file,
           "cell " + std::to_string(c) + " has " +
               std::to_string(grid->GetCells()->GetCellSize(c)) + " corners, but its type has " +
               std::to_string(expected));
    if (!known.at(type & 255) && !grid->GetCell(c))
      stop(file,
           "cell " + std::to_string(c) + " is of the type " + std::to_string(type) +
               ", which VTK does not know");
    known.at(type & 255) = true;
  }
}

/* ---------------------------------------------------------------------- */

void guard_against_files()
{
  std::atexit(name_file);        // CGNS's library ends programs
  static char stack[1 << 16];    // since a stack that overflowed has no room for the handler
  stack_t other{};
  other.ss_sp = stack;
  other.ss_size = sizeof(stack);
  sigaltstack(&other, nullptr);
  struct sigaction action {};
  action.sa_handler = answer;
  action.sa_flags = SA_ONSTACK | SA_RESETHAND;
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    sigaction(signal, &action, nullptr);
  action.sa_handler = answer_time;
  sigaction(SIGPROF, &action, nullptr);
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGPROF;
  if (timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &timer) != 0) return;    // nor limits
#ifdef __SANITIZE_ADDRESS__
  return;    // its own memory is larger than any limit
#endif

  const double pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  rlimit memory{};
  if (pages <= 0.0 || page <= 0.0 || getrlimit(RLIMIT_DATA, &memory) != 0) return;
  const auto most = static_cast<rlim_t>(pages * page);
  if (memory.rlim_cur == RLIM_INFINITY || memory.rlim_cur > most) memory.rlim_cur = most;
  setrlimit(RLIMIT_DATA, &memory);
}

}    // namespace flowgrid
