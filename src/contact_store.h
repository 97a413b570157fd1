// Contacts and liquid bridges kept with the particles they belong to, while particles change index,
// rank or run: lists of contacts hold rows that a rebuild makes invalid, this store holds partner
// IDs. Pair style and walls use it alike (a wall's partner ID is the number of its surface).

#ifndef APF_CONTACT_STORE_H
#define APF_CONTACT_STORE_H

#include "contact/bridge_list.h"
#include "contact/contact_list.h"
#include "lmptype.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

// What each atom remembers of its partners. Memory is made of doubles alone.
template <class Memory> class PartnerRecords {
 public:
  static constexpr int record_size = 1 + Memory::size;    // doubles
  static_assert(sizeof(Memory) == Memory::size * sizeof(double), "packed as it is");

  void clear(int i)
  {
    if (i < rows()) records[i].clear();
  }
  void add(int i, tagint partner, const Memory &memory)
  {
    if (i >= rows()) records.resize(i + 1);
    records[i].push_back({partner, memory});
  }
  // nullptr if atom i had nothing with partner
  const Memory *find(int i, tagint partner) const
  {
    if (i < rows())
      for (const auto &record : records[i])
        if (record.partner == partner) return &record.memory;
    return nullptr;
  }
  int count(int i) const { return i < rows() ? static_cast<int>(records[i].size()) : 0; }

  void copy(int from, int to)
  {
    if (from < rows() && to >= rows()) records.resize(to + 1);
    if (from < rows())
      records[to] = records[from];
    else
      clear(to);
  }

  // gives partners their new IDs; what was with atoms that are gone is dropped
  void renumber(int i, const std::unordered_map<tagint, tagint> &new_id)
  {
    if (i >= rows()) return;
    auto &list = records[i];
    list.erase(std::remove_if(list.begin(), list.end(),
                              [&](const Record &r) {
                                return new_id.count(r.partner) == 0;
                              }),
               list.end());
    for (auto &record : list) record.partner = new_id.at(record.partner);
  }

  void pack_record(int i, int k, double *buf) const
  {
    const auto &record = records[i][k];
    const auto *value = reinterpret_cast<const double *>(&record.memory);
    buf[0] = ubuf(record.partner).d;
    std::copy(value, value + Memory::size, buf + 1);
  }
  void unpack_record(int i, const double *buf)
  {
    Memory memory;
    std::copy(buf + 1, buf + record_size, reinterpret_cast<double *>(&memory));
    add(i, static_cast<tagint>(ubuf(buf[0]).i), memory);
  }
  int size(int i) const { return record_size * count(i); }    // of what pack writes
  double *pack(int i, double *buf) const
  {
    for (int k = 0; k < count(i); k++, buf += record_size) pack_record(i, k, buf);
    return buf;
  }
  const double *unpack(int i, int n, const double *buf)
  {
    for (int k = 0; k < n; k++, buf += record_size) unpack_record(i, buf);
    return buf;
  }

  double memory_usage() const    // [bytes]
  {
    double bytes = records.capacity() * sizeof(records[0]);
    for (const auto &list : records) bytes += list.capacity() * sizeof(Record);
    return bytes;
  }

 private:
  struct Record {
    tagint partner;
    Memory memory;
  };
  std::vector<std::vector<Record>> records;    // one list per atom, as far as there are any
  int rows() const { return static_cast<int>(records.size()); }
};

class ContactStore {
 public:
  PartnerRecords<apf::ContactHistory> contacts;
  PartnerRecords<apf::BridgeMemory> bridges;

  void grow(int n)
  {
    if (n <= static_cast<int>(owners.size())) return;
    owners.resize(n, 0);
    if (keeps_liquid()) liquid.resize(n, NAN);
  }
  void clear(int i)
  {
    contacts.clear(i);
    bridges.clear(i);
    owners[i] = 0;
  }
  void clear_range(int first, int last)
  {
    grow(last);
    for (int i = first; i < last; i++) clear(i);
  }
  void insert(int i)    // a new atom
  {
    clear(i);
    if (keeps_liquid()) liquid[i] = NAN;
  }

  // the ID under which atom i was stored, 0 if it was not: commands between runs may number anew
  tagint owner(int i) const { return owners[i]; }
  void set_owner(int i, tagint id) { owners[i] = id; }
  void renumber(int i, tagint id, const std::unordered_map<tagint, tagint> &new_id)
  {
    owners[i] = id;
    contacts.renumber(i, new_id);
    bridges.renumber(i, new_id);
  }

  // Liquid that an atom has on its surface; NAN until somebody says how much. Kept from the first
  // call of keep_liquid() on.
  bool keeps_liquid() const { return !liquid.empty(); }
  void keep_liquid() { liquid.resize(std::max<size_t>(owners.size(), 1), NAN); }
  std::vector<double> liquid;

  void copy(int from, int to)
  {
    contacts.copy(from, to);
    bridges.copy(from, to);
    owners[to] = owners[from];
    if (keeps_liquid()) liquid[to] = liquid[from];
  }

  // number of doubles that pack writes; no more than before where there is no liquid
  int size(int i) const { return 2 + contacts.size(i) + bridges.size(i) + keeps_liquid(); }
  int max_size(int n) const
  {
    int largest = 3;
    for (int i = 0; i < n; i++) largest = std::max(largest, size(i));
    return largest;
  }

  int pack(int i, double *buf) const
  {
    double *const start = buf;
    *buf++ = contacts.count(i) + per_bridge * bridges.count(i) + (keeps_liquid() ? with_liquid : 0);
    *buf++ = ubuf(owners[i]).d;
    if (keeps_liquid()) *buf++ = liquid[i];
    buf = bridges.pack(i, contacts.pack(i, buf));
    return static_cast<int>(buf - start);
  }

  // appends to what atom i has; returns the number of doubles read
  int unpack(int i, const double *buf)
  {
    const double *const start = buf;
    auto what = static_cast<int64_t>(*buf++);
    owners[i] = static_cast<tagint>(ubuf(*buf++).i);
    if (what >= with_liquid) {
      if (!keeps_liquid()) keep_liquid();
      liquid[i] = *buf++;
      what -= with_liquid;
    }
    buf = contacts.unpack(i, static_cast<int>(what % per_bridge), buf);
    buf = bridges.unpack(i, static_cast<int>(what / per_bridge), buf);
    return static_cast<int>(buf - start);
  }

  double memory_usage() const    // [bytes]
  {
    return contacts.memory_usage() + bridges.memory_usage() + owners.capacity() * sizeof(tagint) +
        liquid.capacity() * sizeof(double);
  }

 private:
  std::vector<tagint> owners;

  // what a packed atom has is told by one number
  static constexpr int64_t per_bridge = 1 << 20, with_liquid = int64_t{1} << 40;
};

}    // namespace LAMMPS_NS

#endif
