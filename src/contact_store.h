// Histories of contacts kept with the particles they belong to, while particles change index, rank
// or run: contact lists hold rows that a rebuild makes invalid, this store holds partner IDs.
// Pair style and walls use it alike (a wall's partner ID is the number of its surface).

#ifndef APF_CONTACT_STORE_H
#define APF_CONTACT_STORE_H

#include "contact/contact_list.h"
#include "lmptype.h"

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {

class ContactStore {
 public:
  void grow(int n)
  {
    if (n > static_cast<int>(records.size())) records.resize(n);
  }
  void clear(int i) { records[i].clear(); }
  void clear_range(int first, int last)
  {
    grow(last);
    for (int i = first; i < last; i++) records[i].clear();
  }

  void add(int i, tagint partner, const apf::ContactHistory &history)
  {
    records[i].push_back({partner, history});
  }

  // nullptr if atom i had no contact with partner
  const apf::ContactHistory *find(int i, tagint partner) const
  {
    for (const auto &record : records[i])
      if (record.partner == partner) return &record.history;
    return nullptr;
  }

  void copy(int from, int to) { records[to] = records[from]; }

  // number of doubles that pack writes
  int size(int i) const { return 1 + width * static_cast<int>(records[i].size()); }
  int max_size(int n) const
  {
    int largest = 1;
    for (int i = 0; i < n; i++) largest = std::max(largest, size(i));
    return largest;
  }

  int pack(int i, double *buf) const
  {
    int m = 0;
    buf[m++] = static_cast<double>(records[i].size());
    for (const auto &record : records[i]) {
      buf[m++] = ubuf(record.partner).d;
      const auto *value = reinterpret_cast<const double *>(&record.history);
      m = static_cast<int>(std::copy(value, value + apf::ContactHistory::size, buf + m) - buf);
    }
    return m;
  }

  // appends to what atom i has
  int unpack(int i, const double *buf)
  {
    int m = 0;
    const int n = static_cast<int>(buf[m++]);
    for (int k = 0; k < n; k++) {
      Record record;
      record.partner = static_cast<tagint>(ubuf(buf[m++]).i);
      std::copy(buf + m, buf + m + apf::ContactHistory::size,
                reinterpret_cast<double *>(&record.history));
      m += apf::ContactHistory::size;
      records[i].push_back(record);
    }
    return m;
  }

  // [bytes]
  double memory_usage() const
  {
    double bytes = records.capacity() * sizeof(records[0]);
    for (const auto &list : records) bytes += list.capacity() * sizeof(Record);
    return bytes;
  }

 private:
  struct Record {
    tagint partner;
    apf::ContactHistory history;
  };
  static constexpr int width = 1 + apf::ContactHistory::size;
  std::vector<std::vector<Record>> records;    // one list per atom
};

}    // namespace LAMMPS_NS

#endif
