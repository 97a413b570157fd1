#include "restart_state.h"

#include "error.h"
#include "fix.h"
#include "utils.h"

#include <cstring>

using namespace LAMMPS_NS;

bool RestartMark::known() const
{
  return std::memcmp(this, RestartMark().name, sizeof(name) + sizeof(format)) == 0;
}

void RestartState::write(LAMMPS *lmp, const Fix *owner, const std::vector<double> &numbers,
                         FILE *file)
{
  RestartMark mark;
  mark.count = static_cast<unsigned>(numbers.size());
  const int bytes = static_cast<int>(sizeof(mark) + numbers.size() * sizeof(double));
  fwrite(&bytes, sizeof(int), 1, file);
  fwrite(&mark, sizeof(mark), 1, file);
  fwrite(numbers.data(), sizeof(double), numbers.size(), file);
  if (fflush(file) != 0)
    lmp->error->one(FLERR, Error::NOLASTLINE, "Fix {} {}: the restart file cannot be written: {}",
                    owner->style, owner->id, utils::getsyserror());
}

RestartState::RestartState(LAMMPS *lmp, const Fix *owner, const char *buffer) :
    Pointers(lmp), owner(owner), at(reinterpret_cast<const double *>(buffer + sizeof(RestartMark)))
{
  RestartMark mark;
  std::memcpy(&mark, buffer, sizeof(mark));
  if (!mark.known()) refuse("another version of APF wrote it");
  left = mark.count;
}

double RestartState::next()
{
  return *next(1);
}

const double *RestartState::next(size_t count)
{
  if (count > left) refuse("it is too short");
  left -= count;
  at += count;
  return at - count;
}

size_t RestartState::count()
{
  const double n = next();
  if (!(n >= 0.0 && n <= static_cast<double>(left))) refuse("it is damaged");
  return static_cast<size_t>(n);
}

std::string RestartState::text()
{
  const size_t length = count();
  const double *letters = next(length);
  std::string words;
  for (size_t k = 0; k < length; k++) {
    if (!is_printable(letters[k])) refuse("it is damaged");
    words += static_cast<char>(letters[k]);
  }
  return words;
}

void RestartState::end()
{
  if (left) refuse("it is too long");
}

void RestartState::refuse(const std::string &why)
{
  error->all(FLERR, Error::NOLASTLINE,
             "Fix {} {}: its part of the restart file cannot be used: {}; go on with the version "
             "that wrote the file, or give the fix another ID to begin anew",
             owner->style, owner->id, why);
}
