// The contacts of one tile at a time (islands.h), copied from a list side by side and written back.

#ifndef APF_CONTACT_TILES_H
#define APF_CONTACT_TILES_H

#include "contact_list.h"
#include "islands.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace apf {

class ContactTiles {
 public:
  // near: candidates that may touch; tile_of_contact(k), tile_of_near(n)
  template <class OfContact, class OfNear>
  void part(const ContactList &list, const std::vector<int> &near, int tiles,
            OfContact tile_of_contact, OfNear tile_of_near)
  {
    contacts.sort(list.size(), tiles, tile_of_contact);
    pairs.sort(static_cast<int>(near.size()), tiles, tile_of_near);
  }

  // From here to leave() list and near are those of the tile alone.
  void enter(int tile, ContactList &list, std::vector<int> &near)
  {
    now = tile;
    std::swap(list, rest);
    std::swap(list.kinds, rest.kinds);
    std::swap(near, rest_near);
    near.clear();
    for (const int *n = pairs.begin(tile); n < pairs.end(tile); n++) near.push_back(rest_near[*n]);
    for (const int *k = contacts.begin(tile); k < contacts.end(tile); k++) list.copy(rest, *k);
    for (const int kind : list.kind) list.kinds.use(kind);
  }

  void leave(ContactList &list, std::vector<int> &near)
  {
    const int *of_rest = contacts.begin(now), n = contacts.size(now);
    left.assign(n, 0);
    for (int k = 0; k < list.size(); k++) {
      int m =
          k;    // the contact's place in the tile at first; those of ended ones are taken by others
      if (m >= n || rest.source[of_rest[m]] != list.source[k])
        for (m = 0; m < n && rest.source[of_rest[m]] != list.source[k];) m++;
      if (m == n) {
        made.copy(list, k);
        continue;
      }
      left[m] = 1;
      rest.take(of_rest[m], list, k);
      list.kinds.release(list.kind[k]);
    }
    for (int m = 0; m < n; m++)
      if (!left[m]) ended.push_back(of_rest[m]);
    list.drop();
    std::swap(list.kinds, rest.kinds);
    std::swap(list, rest);
    std::swap(near, rest_near);
  }

  // The list follows what has become of the contacts of its tiles.
  void join(ContactList &list)
  {
    std::sort(ended.begin(), ended.end());
    for (; !ended.empty(); ended.pop_back()) list.remove(ended.back());
    for (int k = 0; k < made.size(); k++) list.copy(made, k);
    made.drop();
  }

  double memory_usage() const    // [bytes]
  {
    return contacts.memory_usage() + pairs.memory_usage() + rest.memory_usage();
  }

 private:
  ByTile contacts, pairs;
  int now = 0;
  ContactList rest;    // outside a tile: room for its contacts; within: all contacts
  ContactList made;    // in tiles that have been left
  std::vector<int> rest_near;
  std::vector<int> ended;    // numbers in the list
  std::vector<char> left;
};

}    // namespace apf

#endif
