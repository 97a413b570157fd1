// Histories of contacts kept with the particles they belong to, while particles change index, rank
// or run: contact lists hold rows that a rebuild makes invalid, this store holds partner IDs.
// Pair style and walls use it alike (a wall's partner ID is the number of its surface).

#ifndef APF_CONTACT_STORE_H
#define APF_CONTACT_STORE_H

#include "contact/contact_list.h"
#include "lmptype.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

class ContactStore {
 public:
  static constexpr int record_size = 1 + apf::ContactHistory::size;    // doubles

  void grow(int n)
  {
    if (n <= static_cast<int>(records.size())) return;
    records.resize(n);
    owners.resize(n, 0);
  }
  void clear(int i)
  {
    records[i].clear();
    owners[i] = 0;
  }
  void clear_range(int first, int last)
  {
    grow(last);
    for (int i = first; i < last; i++) clear(i);
  }

  void add(int i, tagint partner, const apf::ContactHistory &history)
  {
    records[i].push_back({partner, history});
  }

  // the ID under which atom i was stored, 0 if it was not: commands between runs may number anew
  tagint owner(int i) const { return owners[i]; }
  void set_owner(int i, tagint id) { owners[i] = id; }

  // Gives partners their new IDs; contacts with atoms that are gone are dropped.
  void renumber(int i, tagint id, const std::unordered_map<tagint, tagint> &new_id)
  {
    owners[i] = id;
    auto &list = records[i];
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&](const Record &r) {
                                return new_id.count(r.partner) == 0;
                              }),
               list.end());
    for (auto &record : list) record.partner = new_id.at(record.partner);
  }

  // nullptr if atom i had no contact with partner
  const apf::ContactHistory *find(int i, tagint partner) const
  {
    for (const auto &record : records[i])
      if (record.partner == partner) return &record.history;
    return nullptr;
  }

  void copy(int from, int to)
  {
    records[to] = records[from];
    owners[to] = owners[from];
  }

  int count(int i) const { return static_cast<int>(records[i].size()); }

  // number of doubles that pack writes
  int size(int i) const { return 2 + record_size * count(i); }
  int max_size(int n) const
  {
    int largest = 2;
    for (int i = 0; i < n; i++) largest = std::max(largest, size(i));
    return largest;
  }

  int pack(int i, double *buf) const
  {
    const int n = count(i);
    buf[0] = n;
    buf[1] = ubuf(owners[i]).d;
    for (int k = 0; k < n; k++) pack_record(i, k, buf + 2 + k * record_size);
    return size(i);
  }

  // appends to what atom i has; returns the number of doubles read
  int unpack(int i, const double *buf)
  {
    const int n = static_cast<int>(buf[0]);
    owners[i] = static_cast<tagint>(ubuf(buf[1]).i);
    for (int k = 0; k < n; k++) unpack_record(i, buf + 2 + k * record_size);
    return 2 + n * record_size;
  }

  void pack_record(int i, int k, double *buf) const
  {
    const auto &record = records[i][k];
    const auto *value = reinterpret_cast<const double *>(&record.history);
    buf[0] = ubuf(record.partner).d;
    std::copy(value, value + apf::ContactHistory::size, buf + 1);
  }

  void unpack_record(int i, const double *buf)
  {
    Record record;
    record.partner = static_cast<tagint>(ubuf(buf[0]).i);
    std::copy(buf + 1, buf + record_size, reinterpret_cast<double *>(&record.history));
    records[i].push_back(record);
  }

  // [bytes]
  double memory_usage() const
  {
    double bytes = records.capacity() * (sizeof(records[0]) + sizeof(tagint));
    for (const auto &list : records) bytes += list.capacity() * sizeof(Record);
    return bytes;
  }

 private:
  struct Record {
    tagint partner;
    apf::ContactHistory history;
  };
  std::vector<std::vector<Record>> records;    // one list per atom
  std::vector<tagint> owners;
};

}    // namespace LAMMPS_NS

#endif
