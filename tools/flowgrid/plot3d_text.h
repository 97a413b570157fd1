// Which kind of PLOT3D grid a text file is. Neither the number of blocks, nor the dimension, nor
// the marks of blanked points need be said in such a file; what fits its numbers is taken. Binary
// files are told apart by VTK.

#ifndef FLOWGRID_PLOT3D_TEXT_H
#define FLOWGRID_PLOT3D_TEXT_H

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace flowgrid {

struct Plot3dText {
  bool text = false;     // else the rest says nothing
  bool known = false;    // what kind of grid that is:
  bool multiple = false, planar = false, blanked = false;

  explicit Plot3dText(const std::string &path)
  {
    std::ifstream in(path, std::ios::binary);
    char start[256];
    in.read(start, sizeof(start));
    const std::string head(start, static_cast<size_t>(in.gcount()));
    text = !head.empty() && head.find_first_not_of("0123456789+-.eEdD \t\r\n") == std::string::npos;
    if (!text) return;
    in.clear();
    in.seekg(0);
    std::vector<double> first;    // numbers that may be sizes
    double count = 0.0, blocks = 1.0;
    for (std::string word; in >> word;) {
      count++;
      if (first.size() >= 1 + 3 * blocks) continue;
      first.push_back(std::strtod(word.c_str(), nullptr));
      blocks = std::max(1.0, std::min(first[0], 1e5));
    }
    for (const bool many : {true, false})
      for (const bool flat : {false, true})
        for (const bool marks : {false, true})
          if (!known && count == numbers(first, many, flat, marks)) {
            known = true;
            multiple = many;
            planar = flat;
            blanked = marks;
          }
  }

 private:
  static bool is_count(double a) { return a >= 1.0 && a == std::floor(a); }

  // how many there must be in the file; 0 if there cannot be such a file
  static double numbers(const std::vector<double> &first, bool many, bool flat, bool marks)
  {
    const int axes = flat ? 2 : 3;
    const size_t sizes = many ? 1 : 0, values = axes + marks;
    if (first.size() < sizes) return 0.0;
    const double blocks = many ? first[0] : 1.0;
    if (!is_count(blocks) || static_cast<double>(first.size()) < sizes + axes * blocks) return 0.0;
    double sum = static_cast<double>(sizes) + axes * blocks;
    for (size_t b = 0; b < static_cast<size_t>(blocks); b++) {
      double points = 1.0;
      for (int a = 0; a < axes; a++) {
        const double n = first[sizes + axes * b + a];
        if (!is_count(n)) return 0.0;
        points *= n;
      }
      sum += points * static_cast<double>(values);
    }
    return sum;
  }
};

}    // namespace flowgrid

#endif
