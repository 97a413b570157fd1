#include "restart_state.h"

#include "error.h"
#include "fix.h"
#include "utils.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

static const char *const of_version =
    "go on with the version that wrote the file, or give the fix another ID to begin anew";

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
    RestartNumbers(lmp, owner, reinterpret_cast<const double *>(buffer + sizeof(RestartMark)), 0,
                   true)
{
  RestartMark mark;
  std::memcpy(&mark, buffer, sizeof(mark));
  if (!mark.known()) refuse("another version of APF wrote it", of_version);
  left = mark.count;
}

/* ---------------------------------------------------------------------- */

double RestartNumbers::next(const Range &range)
{
  const double number = *next(1);
  if (!range.holds(number)) damaged();
  return number;
}

double RestartNumbers::whole(double low, double high)
{
  const double number = next(Range::from(low, high));
  if (number != std::floor(number)) damaged();
  return number;
}

const double *RestartNumbers::next(size_t count)
{
  const double *numbers = bits(count);
  for (size_t k = 0; k < count; k++)
    if (!std::isfinite(numbers[k])) damaged();
  return numbers;
}

const double *RestartNumbers::bits(size_t count)
{
  if (count > left) refuse("it is too short", of_version);
  left -= count;
  at += count;
  return at - count;
}

void RestartNumbers::skip_id()
{
  const auto id = ubuf(*bits(1)).i;
  if (id < 0 || id > MAXTAGINT) damaged();
}

std::string RestartNumbers::text()
{
  const size_t length = count();
  const double *letters = next(length);
  std::string words;
  for (size_t k = 0; k < length; k++) {
    if (!is_printable(letters[k])) damaged();
    words += static_cast<char>(letters[k]);
  }
  return words;
}

RestartNumbers RestartNumbers::part()
{
  const auto size = static_cast<size_t>(whole(1.0, static_cast<double>(left))) - 1;
  return {lmp, owner, bits(size), size, together};
}

void RestartNumbers::end()
{
  if (left) refuse("it is too long", of_version);
}

void RestartNumbers::damaged()
{
  refuse("it is damaged", "use another file");
}

void RestartNumbers::refuse(const std::string &why, const std::string &cure)
{
  const auto text = fmt::format("Fix {} {}: its part of the restart file cannot be used: {}; {}",
                                owner->style, owner->id, why, cure);
  if (together)
    error->all(FLERR, Error::NOLASTLINE, text);
  else
    error->one(FLERR, Error::NOLASTLINE, text);
}
