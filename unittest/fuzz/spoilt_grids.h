// Files of walls and flows whose numbers are spoilt, for fuzz_commands: the file itself is right.

#ifndef APF_FUZZ_SPOILT_GRIDS_H
#define APF_FUZZ_SPOILT_GRIDS_H

#include "commands.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <limits>
#include <random>
#include <string>

namespace fuzz {

class SpoiltGrids {
 public:
  explicit SpoiltGrids(unsigned seed) : random(seed) {}

  struct Spoilt {
    std::string what;      // was done, for messages
    bool wrong = false;    // for sure: no run may go on with it
    bool is_wall = false;
    std::string command{};    // that names the file
  };

  // the file that the command names, spoilt, under the name that the command has then
  Spoilt write(const std::string &command)
  {
    static const std::string right[] = {walls_file, flow_file}, spoilt = "spoilt.vtkhdf";
    Spoilt result;
    result.is_wall = command.find(walls_file) != std::string::npos;
    const auto &name = right[result.is_wall ? 0 : 1];
    result.command = command;
    result.command.replace(command.find(name), name.size(), spoilt);
    std::size_t arrays;    // which ones, in bits
    const auto one = any(result.what, arrays, result.is_wall, result.wrong);
    const auto in = [&](std::size_t bit) {
      return arrays & bit ? one : Spoil(as_it_is);
    };
    if (result.is_wall)
      write_walls(spoilt, watched(in(1), result), watched(in(2), result));
    else
      write_flow(spoilt, watched(in(1), result), watched(in(2), result));
    return result;
  }

  static bool can(const std::string &command)
  {
    return command.find(walls_file) != std::string::npos ||
        command.find(flow_file) != std::string::npos;
  }

 private:
  std::mt19937 random;

  double uniform(double lo, double hi)
  {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  }
  double power(double lo, double hi) { return std::pow(10.0, uniform(lo, hi)); }
  double sign() { return random() % 2 ? 1.0 : -1.0; }

  // beyond what is read
  static Spoil watched(const Spoil &spoil, Spoilt &result)
  {
    return [spoil, &result](const double *x, double right) {
      const double value = spoil(x, right);
      result.wrong = result.wrong || !(std::fabs(value) <= 1e100);
      return value;
    };
  }

  Spoil scaled(double factor, bool is_wall, bool &wrong)
  {
    wrong = is_wall && std::fabs(factor - 1.0) > 0.03;
    return [factor](const double *, double right) {
      return factor * right;
    };
  }

  Spoil any(std::string &what, std::size_t &arrays, bool is_wall, bool &wrong)
  {
    arrays = 1 + random() % 3;
    const auto call = [&](const std::string &kind, double number) {
      char text[40];
      std::snprintf(text, sizeof(text), " %.17g", number);
      what = kind + text + ", arrays " + std::to_string(arrays);
      return number;
    };
    switch (random() % 10) {
      case 0:
        return scaled(call("huge", power(6.0, 308.0)), is_wall, wrong);
      case 1:
        return scaled(call("tiny", power(-323.0, -6.0)), is_wall, wrong);
      case 2:
        return scaled(call("scale", sign() * power(-6.0, 6.0)), is_wall, wrong);
      case 3: {
        static const double numbers[] = {0.0, 0.5, 1.0, -0.5, 5.0, -5.0, 5e-324, 1e50, -1e100, NAN};
        const double number = call("constant", numbers[random() % std::size(numbers)]);
        return [number](const double *, double) {
          return number;
        };
      }
      case 4: {
        const double size = call("alternating", power(-5.0, 308.0));
        return [size](const double *x, double) {
          return std::lround(x[0] + x[1] + x[2]) % 2 ? size : -size;
        };
      }
      case 5: {
        static const double numbers[] = {NAN, HUGE_VAL, -HUGE_VAL, 1e308, -1e308, 1e100};
        const std::size_t choice = random() % (2 * std::size(numbers));
        const double number = call(
            "spike", choice < std::size(numbers) ? numbers[choice] : sign() * power(-3.0, 308.0));
        const auto some = [this] {
          return static_cast<double>(random() % 9);
        };
        const std::array<double, 3> at = {some(), some(), some()};
        return [number, at](const double *x, double right) {
          return x[0] == at[0] && x[1] == at[1] && x[2] == at[2] ? number : right;
        };
      }
      case 6: {
        const double side = call("one sign", sign());
        return [side](const double *, double right) {
          return side * std::fabs(right);
        };
      }
      case 7: {
        const double size = call("noise", power(-12.0, 308.0));
        const unsigned seed = random();
        return [size, seed](const double *x, double right) {
          std::mt19937 mine(seed + static_cast<unsigned>(x[0] + 9.0 * (x[1] + 9.0 * x[2])));
          return right + size * std::uniform_real_distribution<double>(-1.0, 1.0)(mine);
        };
      }
      case 8: {
        const double size = call("step", power(-5.0, 308.0)), middle = uniform(0.0, 8.0);
        const std::size_t axis = random() % 3;
        return [size, middle, axis](const double *x, double) {
          return x[axis] > middle ? size : -size;
        };
      }
      default: {
        const double shift = call("shifted by", sign() * power(-6.0, 100.0));
        return [shift](const double *, double right) {
          return right + shift;
        };
      }
    }
  }
};

}    // namespace fuzz

#endif
