#include "shape_parser.h"
#include "decimals.h"

#include "polygon.h"

#include <cstdlib>
#include <stdexcept>

namespace flowgrid {

namespace {

  constexpr const char *known =
      "box, sphere, cylinder, plane, rectangle, disc, polygon, extrude, union, intersection, "
      "difference, inside";

  class Parser {
   public:
    Parser(const std::string &text, const Periods &periods, ShapeTree &tree) :
        text(text), periods(periods), tree(tree)
    {
    }

    void parse()
    {
      ShapeTree::Solid solid;
      solid.name = word();
      if (solid.name.empty()) stop("a shape begins with its name and a colon");
      check_zone_name(solid.name);
      for (const auto &other : tree.solids)
        if (other.name == solid.name) stop("there are two shapes " + solid.name);
      expect(':');
      solid.root = shape();
      skip_blanks();
      if (at < text.size()) stop("nothing may follow the shape");
      tree.solids.push_back(solid);
    }

   private:
    const std::string &text;
    const Periods &periods;
    ShapeTree &tree;
    size_t at = 0;
    int depth = 0;    // of shapes within shapes
    static constexpr int deepest = 100;

    [[noreturn]] void stop(const std::string &why) const
    {
      throw std::runtime_error("--shape: " + why + "\n  " + text + "\n  " + std::string(at, ' ') +
                               "^");
    }
    void skip_blanks()
    {
      while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) at++;
    }
    bool next_is(char c)
    {
      skip_blanks();
      return at < text.size() && text[at] == c;
    }
    void expect(char c)
    {
      if (!next_is(c)) stop(std::string("expected ") + c);
      at++;
    }
    std::string word()
    {
      skip_blanks();
      const size_t first = at;
      while (at < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_'))
        at++;
      return text.substr(first, at - first);
    }

    double number()
    {
      skip_blanks();
      char *end;
      const double value = std::strtod(text.c_str() + at, &end);
      if (end == text.c_str() + at || !std::isfinite(value)) stop("expected a number");
      at = end - text.c_str();
      return value;
    }
    // numbers up to the closing bracket: `count` of them, any number if that is 0
    std::vector<double> numbers(const std::string &of, size_t count)
    {
      std::vector<double> list{number()};
      while (next_is(',')) {
        at++;
        list.push_back(number());
      }
      if (count && list.size() != count)
        stop(of + " takes " + std::to_string(count) + " numbers, got " +
             std::to_string(list.size()));
      return list;
    }
    std::vector<int> shapes()
    {
      std::vector<int> list{shape()};
      while (next_is(',')) {
        at++;
        list.push_back(shape());
      }
      return list;
    }

    int shape()
    {
      skip_blanks();
      const size_t begin = at;
      const std::string name = word();
      if (!next_is('(')) {
        at = begin;
        stop("expected a shape: " + std::string(known));
      }
      at++;
      if (++depth > deepest)
        stop("shapes may be nested " + std::to_string(deepest) + " deep, not deeper");
      const int node = named(name, begin);
      depth--;
      expect(')');
      return node;
    }

    int named(const std::string &name, size_t begin)
    {
      if (name == "union") return tree.either(shapes());
      if (name == "intersection") return tree.both(shapes());
      if (name == "inside") return tree.inverse(shape());
      if (name == "difference") {
        auto of = shapes();
        for (size_t k = 1; k < of.size(); k++) of[k] = tree.inverse(of[k]);
        return tree.both(of);
      }
      if (name == "extrude") {
        const double low = number();
        expect(',');
        const double high = number();
        expect(',');
        if (!(low < high)) stop("extrude needs Z1 < Z2");
        const int of = shape();
        return tree.both(
            {of, copied([&] {
               return tree.both({plane({0, 0, low}, {0, 0, -1}), plane({0, 0, high}, {0, 0, 1})});
             })});
      }
      if (name == "plane") {
        const auto v = numbers(name, 6);
        const Point normal{v[3], v[4], v[5]};
        if (!(length(normal) > 0.0)) stop("the normal of a plane must not be 0");
        if (periods.crossed_by(normal)) stop("a plane across a --periodic direction cannot repeat");
        return plane(point(v, 0), unit(normal));
      }
      if (name == "sphere") {
        const auto v = numbers(name, 4);
        return copied([&] {
          return tree.half_space({Carrier::Kind::sphere, point(v, 0), {}, radius(v[3])});
        });
      }
      if (name == "disc") {
        const auto v = numbers(name, 3);
        return copied([&] {
          return tree.half_space(
              {Carrier::Kind::cylinder, {v[0], v[1], 0}, {0, 0, 1}, radius(v[2])});
        });
      }
      if (name == "cylinder") {
        const auto v = numbers(name, 7);
        return copied([&] {
          return cylinder(v);
        });
      }
      if (name == "box") {
        const auto v = numbers(name, 6);
        return copied([&] {
          return slabs(point(v, 0), point(v, 3), 3);
        });
      }
      if (name == "rectangle") {
        const auto v = numbers(name, 4);
        return copied([&] {
          return slabs({v[0], v[1], 0}, {v[2], v[3], 0}, 2);
        });
      }
      if (name == "polygon") {
        const auto v = numbers(name, 0);
        return copied([&] {
          return polygon(v);
        });
      }
      at = begin;
      stop("there is no shape " + name + "; there are " + known);
    }

    // the union of what make() returns, a node, at all places where it repeats itself
    template <class Make> int copied(const Make &make)
    {
      std::vector<int> copies;
      for (const Point &shift : periods.shifts()) {
        tree.put(shift);
        copies.push_back(make());
      }
      tree.put({});
      return copies.size() == 1 ? copies[0] : tree.either(copies);
    }

    Point point(const std::vector<double> &v, size_t first) const
    {
      return {v[first], v[first + 1], v[first + 2]};
    }
    double radius(double value) const
    {
      if (!(value > 0.0)) stop("a radius must be > 0, got " + text_of(value));
      return value;
    }
    int plane(const Point &through, const Point &normal)
    {
      return tree.half_space({Carrier::Kind::plane, through, normal, 0.0});
    }
    int slabs(const Point &low, const Point &high, int axes)
    {
      std::vector<int> faces;
      for (int c = 0; c < axes; c++) {
        if (!(low[c] < high[c]))
          stop("the second corner must lie above the first along " + std::string(1, "xyz"[c]));
        Point normal{};
        normal[c] = 1.0;
        faces.push_back(plane(low, -1.0 * normal));
        faces.push_back(plane(high, normal));
      }
      return tree.both(faces);
    }
    int cylinder(const std::vector<double> &v)
    {
      const Point from = point(v, 0), to = point(v, 3), axis = unit(to - from);
      if (!(length(to - from) > 0.0)) stop("the ends of a cylinder must differ");
      return tree.both({tree.half_space({Carrier::Kind::cylinder, from, axis, radius(v[6])}),
                        plane(from, -1.0 * axis), plane(to, axis)});
    }
    int polygon(const std::vector<double> &v)
    {
      if (v.size() % 2) stop("polygon takes pairs of coordinates");
      std::vector<Point> corners;
      for (size_t k = 0; k < v.size(); k += 2) corners.push_back({v[k], v[k + 1], 0.0});
      try {
        return Polygon(corners).add_to(tree);
      } catch (const std::runtime_error &error) {
        stop(error.what());
      }
    }
  };

}    // namespace

void check_zone_name(const std::string &name)
{
  for (const char c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_')
      throw std::runtime_error("names of walls take letters, digits and _, got " + name);
  if (name.empty()) throw std::runtime_error("a wall needs a name");
}

void parse_shape(const std::string &text, const Periods &periods, ShapeTree &tree)
{
  Parser(text, periods, tree).parse();
}

}    // namespace flowgrid
