// Command lines of flowgrid with words that nobody should write, each in a child process of its
// own. The program must end with status 1 or 2 and a message that names a word or a file, and
// leave what was there before; or with 0 and a grid that fix flow/field and fix wall/levelset
// can read.
//
//   fuzz_flowgrid NUMBER [SEED] [all]    all: prints all messages

#include "child.h"
#include "input_folder.h"
#include "read_vtkhdf.h"
#include "spoil.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>

#define main flowgrid_main    // the program itself, to be called in a child
#include "flowgrid.cpp"       // NOLINT(bugprone-suspicious-include): see above
#undef main

namespace {

using fuzz::Outcome;

// NOLINTBEGIN(bugprone-suspicious-missing-comma): long ones go on
const std::string commands[] = {
    "mesh.vti out.vtkhdf --spacing 0.5 --compress",
    "mesh.vti out.vtkhdf --spacing 0.5 0.5 1 --bounds 0 1 0 2 0 2 --velocity U --pressure p "
    "--times last "
    "--scale 1.0",
    "mesh.vti out.vtkhdf --spacing 0.5 --planar 1.0 --times all",
    "mesh.vti out.vtkhdf --spacing 0.5 --distance --particle 0.3",
    "grid.x out.vtkhdf --solution flow.q --spacing 0.25",
    "mesh.vti out.vtkhdf --spacing 0.5 --shape a:cylinder(1,1,0,1,1,2,0.3) --fluid-at 0.1 0.1 0.1",
    "out.vtkhdf --spacing 0.5 --bounds -1 1 -1 1 -1 1 --shape a:sphere(0,0,0,0.6) --exact 0.5 "
    "--band 6 "
    "--crease 40 --particle 0.3 --isosurface wall.stl",
    "out.vtkhdf --spacing 0.5 --bounds -1 1 -1 1 -1 1 --shape "
    "b:intersection(box(-0.5,-0.5,-0.5,0.5,0.5,0.5),sphere(0,0,0,0.7)) --periodic yz --isosurface "
    "wall.vtp "
    "--compress",
    "out.vtkhdf --spacing 0.5 --bounds -1 1 -1 1 0 1 --planar 0.5 --shape "
    "c:polygon(-0.5,-0.5,0.5,-0.5,0,0.6) --particle 0.1",
    "out.vtkhdf --spacing 0.4 --bounds -1 1 -1 1 -1 1 --wall-surface solid.stl:solid --fluid-at "
    "0.9 0.9 0.9",
};
// NOLINTEND(bugprone-suspicious-missing-comma)

// a tetrahedron, a cube of eight cells whose velocity is (y, 0, 0), and two cells of PLOT3D
void write_inputs()
{
  std::ofstream stl("solid.stl"), vti("mesh.vti");
  const double corner[4][3] = {
      {-0.5, -0.5, -0.5}, {0.6, -0.5, -0.5}, {-0.5, 0.6, -0.5}, {-0.5, -0.5, 0.6}};
  stl << "solid solid\n";
  for (const auto &face : {std::array<int, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    stl << "facet normal 0 0 0\nouter loop\n";
    for (const int k : face)
      stl << "vertex " << corner[k][0] << ' ' << corner[k][1] << ' ' << corner[k][2] << '\n';
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid solid\n";
  vti << "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 2 0 2 0 2\" "
         "Origin=\"0 0 0\" "
         "Spacing=\"1 1 1\"><Piece Extent=\"0 2 0 2 0 2\"><PointData><DataArray type=\"Float64\" "
         "Name=\"U\" "
         "NumberOfComponents=\"3\" format=\"ascii\">";
  for (int k = 0; k < 27; k++) vti << k / 3 % 3 << " 0 0 ";
  vti << "</DataArray><DataArray type=\"Float64\" Name=\"p\" format=\"ascii\">";
  for (int k = 0; k < 27; k++) vti << k % 3 << ' ';
  vti << "</DataArray></PointData></Piece></ImageData></VTKFile>";
  std::ofstream("grid.x") << "3 2\n0 1 2 0 1 2\n0 0 0 1 1 1\n";
  std::ofstream("flow.q") << "3 2\n0.5 0 1 0\n2 2 2 2 2 2\n2 2 2 4 4 4\n0 -1 -2 0 -1 -2\n"
                             "9 9 9 9 9 9\n";
}

const std::string before = "was there before";

void begin_output()
{
  std::ofstream("out.vtkhdf") << before;
}
bool output_is_untouched()
{
  std::ifstream in("out.vtkhdf");
  return std::string(std::istreambuf_iterator<char>(in), {}) == before;
}

// What spoilt words made of inputs, output and more goes again.
void begin_anew()
{
  for (const auto &entry : std::filesystem::directory_iterator("."))
    std::filesystem::remove_all(entry.path());
  write_inputs();
}

fuzz::Ended run(const fuzz::Words &words)
{
  return fuzz::in_child(
      [&](int out) {
        dup2(out, 1);
        dup2(out, 2);
        std::vector<char *> argv = {const_cast<char *>("flowgrid")};
        for (const auto &word : words) argv.push_back(const_cast<char *>(word.c_str()));
        const int count = static_cast<int>(argv.size());
        argv.push_back(nullptr);
        const int status = flowgrid_main(count, argv.data());
        std::fflush(stdout);
        return status;
      },
      60, rlim_t(4) << 30);
}

// a refusal names an option, or a word of the command
bool says_what_is_wrong(const std::string &message, const fuzz::Words &words)
{
  const size_t at = message.find("flowgrid: ");
  if (at == std::string::npos) return false;
  const std::string reason = message.substr(at);
  if (reason.find("--") < reason.find("flowgrid --help") ||
      reason.find("INPUT") != std::string::npos)
    return true;
  for (const auto &word : words)
    if (reason.find(word.substr(0, word.find(':', 1))) != std::string::npos) return true;
  return false;
}

Outcome try_words(const std::string &command)
{
  begin_anew();
  begin_output();
  const auto words = fuzz::split(command);
  const auto ended = run(words);
  if (!ended.death.empty()) return {Outcome::FAILED, ended.death};
  const bool asked = command.find("--help") != std::string::npos ||
      command.find("-h") != std::string::npos;
  if (ended.status == 0) {
    if (!asked && output_is_untouched() && command.find("out.vtkhdf") != std::string::npos)
      return {Outcome::FAILED, "done, but nothing is written"};
    if (!output_is_untouched()) {
      const auto read = fuzz::in_child(
          [](int) {
            fuzz::read_vtkhdf("out.vtkhdf");
            return apf::VtkhdfFile("out.vtkhdf").arrays().empty() ? 1 : 0;
          },
          60, rlim_t(4) << 30);
      if (!read.death.empty() || read.status)
        return {Outcome::FAILED, "what is written cannot be read: " + read.death};
    }
    return {Outcome::ACCEPTED, ""};
  }
  if (ended.status > 2)
    return {Outcome::FAILED, "status " + std::to_string(ended.status) + ": " + ended.text};
  if (!output_is_untouched())
    return {Outcome::FAILED, "refused, and the output is another: " + ended.text};
  if (!says_what_is_wrong(ended.text, words))
    return {Outcome::FAILED, "does not say what is wrong: " + ended.text};
  return {Outcome::REFUSED, ended.text.substr(ended.text.find("flowgrid: "))};
}

// messages that differ in numbers and words only are about one
std::string kind_of(const std::string &message)
{
  std::string kind;
  for (const char c : message.substr(0, message.find('\n')))
    if (!std::isdigit(static_cast<unsigned char>(c))) kind += c;
  return kind.substr(0, 100);
}

}    // namespace

int main(int argc, char **argv)
{
  const int number = argc > 1 ? std::atoi(argv[1]) : 1000;
  const unsigned seed = argc > 2 ? std::atoi(argv[2]) : 1;
  const fuzz::InputFolder folder;
  std::filesystem::current_path(folder / "");
  fuzz::Mutator mutator(seed, {std::begin(commands), std::end(commands)});
  int tried = 0, count[3] = {};
  std::map<std::string, int> messages;
  const int each = std::max<int>(1, number / static_cast<int>(std::size(commands)));
  for (const auto &right : commands)
    for (int n = 0; n <= each; n++, tried++) {
      const std::string command = n ? mutator.mutate(right, 0) : right;
      Outcome outcome = try_words(command);
      if (n == 0 && outcome.kind != Outcome::ACCEPTED)
        outcome = {Outcome::FAILED, "should be right: " + outcome.text};
      count[outcome.kind]++;
      if (outcome.kind == Outcome::REFUSED) messages[kind_of(outcome.text)]++;
      if (outcome.kind == Outcome::FAILED)
        printf("FAILED %s\n  %s\n", command.substr(0, 400).c_str(),
               outcome.text.substr(0, 1000).c_str());
    }
  if (argc > 3)
    for (const auto &message : messages) printf("%6d %s\n", message.second, message.first.c_str());
  printf("%d command lines: %d accepted, %d refused, %d failures (seed %u)\n", tried,
         count[Outcome::ACCEPTED], count[Outcome::REFUSED], count[Outcome::FAILED], seed);
  std::filesystem::current_path("/");
  return count[Outcome::FAILED] ? 1 : 0;
}
