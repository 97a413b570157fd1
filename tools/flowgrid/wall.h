// A wall whose distance is known exactly near it, as a whole and piece by piece. A piece has no
// concave crease; where it meets another one its distance goes on as that of the surface continued,
// so that it is smooth wherever the center of a particle can be.

#ifndef FLOWGRID_WALL_H
#define FLOWGRID_WALL_H

#include "mapping.h"
#include "vector.h"

#include <limits>
#include <memory>
#include <string>

namespace flowgrid {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

struct Box {
  Point low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};

  void add(const Point &x)
  {
    for (int c = 0; c < 3; c++) {
      low[c] = std::min(low[c], x[c]);
      high[c] = std::max(high[c], x[c]);
    }
  }
  // distance of a point or another box, 0 inside
  double distance(const Point &x) const { return distance(Box{x, x}); }
  double distance(const Box &other) const
  {
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
      const double gap = std::max({low[c] - other.high[c], other.low[c] - high[c], 0.0});
      sum += gap * gap;
    }
    return std::sqrt(sum);
  }
};

class Wall {
 public:
  struct Piece {
    std::string zone;
    double surface_error = 0.0;    // of what the wall was given by                     [length]
    Box bounds;                    // of the part that the fluid touches
  };

  virtual ~Wall() = default;
  const std::vector<Piece> &pieces() const { return list; }
  const std::vector<std::string> &warnings() const { return remarks; }

  // Signed distance, > 0 in the fluid; unknown if it is larger than limit.            [length]
  virtual double distance(const Point &x, double limit) const = 0;
  // The same to a piece. It is infinite in fluid behind the continuation of the piece.
  virtual double distance(int piece, const Point &x, double limit) const = 0;

 protected:
  std::vector<Piece> list;
  std::vector<std::string> remarks;
};

// Several walls: the fluid is what is in none of their solids.
class JointWall : public Wall {
 public:
  void add(std::unique_ptr<Wall> wall)
  {
    for (size_t p = 0; p < wall->pieces().size(); p++)
      home.push_back({wall.get(), static_cast<int>(p)});
    list.insert(list.end(), wall->pieces().begin(), wall->pieces().end());
    remarks.insert(remarks.end(), wall->warnings().begin(), wall->warnings().end());
    walls.push_back(std::move(wall));
  }
  double distance(const Point &x, double limit) const override
  {
    double least = unknown;
    for (const auto &wall : walls) {
      const double d = wall->distance(x, limit);
      if (!std::isnan(d) && !(d >= least)) least = d;
    }
    return least;
  }
  double distance(int piece, const Point &x, double limit) const override
  {
    return home[piece].first->distance(home[piece].second, x, limit);
  }

 private:
  std::vector<std::unique_ptr<Wall>> walls;
  std::vector<std::pair<const Wall *, int>> home;    // of each piece
};

}    // namespace flowgrid

#endif
