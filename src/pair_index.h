// Numbers of pairs, found by the rows of their two atoms in either order.

#ifndef APF_PAIR_INDEX_H
#define APF_PAIR_INDEX_H

#include <cstdint>
#include <unordered_map>

namespace LAMMPS_NS {

class PairIndex {
 public:
  // index = -1: there is none. sign = -1: the pair's first atom is j
  struct Found {
    int index;
    double sign;
  };

  template <class List> void number(const List &list)    // by its i, j
  {
    numbers.clear();
    for (int k = 0; k < list.size(); k++) numbers[key(list.i[k], list.j[k])] = k;
  }
  Found find(int i, int j) const
  {
    auto found = numbers.find(key(i, j));
    if (found != numbers.end()) return {found->second, 1.0};
    found = numbers.find(key(j, i));
    return {found == numbers.end() ? -1 : found->second, -1.0};
  }

 private:
  std::unordered_map<uint64_t, int> numbers;

  static uint64_t key(int i, int j)
  {
    return (static_cast<uint64_t>(i) << 32) | static_cast<uint32_t>(j);
  }
};

}    // namespace LAMMPS_NS

#endif
