// What atoms remember of their partners, by ID, while rows mean nothing. Records of all atoms stand
// in one array, chained from the last one of each atom to its first, so that no atom has memory of
// its own. Two atoms of a rank share the record of what joins them: each has its own chain through
// it, and its own view of it. Chains are only ever added to at their heads: an atom that takes
// another's place may share its chain.

#ifndef APF_PARTNER_RECORDS_H
#define APF_PARTNER_RECORDS_H

#include "lmptype.h"
#include "restart_state.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

// Memory is made of doubles alone, Memory::size of them: the first Memory::finite are finite, the
// others may be infinite. memory.swapped(planar) is what the partner sees of it.
template <class Memory> class PartnerRecords {
 public:
  static constexpr int record_size = 1 + Memory::size;    // doubles
  static_assert(sizeof(Memory) == Memory::size * sizeof(double), "packed as it is");

  void grow(int atoms)
  {
    if (atoms > static_cast<int>(last.size())) last.resize(atoms, none);
  }
  void clear(int i) { last[i] = none; }

  // all anew, with room for so many records
  void start(size_t room, bool planar)
  {
    in_plane = planar;
    forget_all();
    records.clear();
    records.reserve(room);
  }
  // the lists of contacts go on from here
  void release()
  {
    if (records.capacity() == 0) return;
    records = std::vector<Record>();    // = {} would keep the memory
    forget_all();
  }

  void add(int i, tagint partner, const Memory &memory)
  {
    records.push_back({memory, {partner, 0}, {last[i], none}});
    last[i] = 2 * static_cast<int>(records.size() - 1);
  }
  // as i sees it
  void add(int i, int j, tagint id_i, tagint id_j, const Memory &memory)
  {
    records.push_back({memory, {id_j, id_i}, {last[i], last[j]}});
    last[i] = 2 * static_cast<int>(records.size() - 1);
    last[j] = last[i] + 1;
  }

  // as atom i sees it; nothing if it had none with partner
  std::optional<Memory> find(int i, tagint partner) const
  {
    for (int n = last[i]; n != none; n = before(n))
      if (partner_of(n) == partner) return seen(n);
    return {};
  }

  int count(int i) const
  {
    int sum = 0;
    for (int n = last[i]; n != none; n = before(n)) sum++;
    return sum;
  }

  // a partner with whom atom i has more than one record; 0 if there is none
  tagint repeated(int i) const
  {
    for (int n = last[i]; n != none; n = before(n))
      for (int m = before(n); m != none; m = before(m))
        if (partner_of(m) == partner_of(n)) return partner_of(n);
    return 0;
  }

  void copy(int from, int to) { last[to] = last[from]; }

  // drops what is not kept by keep(partner's ID, memory as i sees it)
  template <class Keep> void keep_if(int i, Keep &&keep)
  {
    for (int *at = &last[i]; *at != none;) {
      int &next = records[*at / 2].before[*at % 2];
      if (keep(partner_of(*at), seen(*at)))
        at = &next;
      else
        *at = next;
    }
  }

  // gives partners their new IDs; what was with atoms that are gone is dropped
  void renumber(int i, const std::unordered_map<tagint, tagint> &new_id)
  {
    for (int *at = &last[i]; *at != none;) {
      Record &record = records[*at / 2];
      const int side = *at % 2;
      const auto found = new_id.find(record.partner[side]);
      if (found == new_id.end()) {
        *at = record.before[side];
      } else {
        record.partner[side] = found->second;
        at = &record.before[side];
      }
    }
  }

  // number k of atom i, in the order in which they were added: what is added does not renumber them
  void pack_record(int i, int k, double *buf) const
  {
    int n = last[i];
    for (int later = count(i) - 1 - k; later > 0; later--) n = before(n);
    const Memory memory = seen(n);
    const auto *value = reinterpret_cast<const double *>(&memory);
    buf[0] = ubuf(partner_of(n)).d;
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
    const int n = count(i);
    for (int k = 0; k < n; k++, buf += record_size) pack_record(i, k, buf);
    return buf;
  }
  const double *unpack(int i, int n, const double *buf)
  {
    for (int k = 0; k < n; k++, buf += record_size) unpack_record(i, buf);
    return buf;
  }

  // an error where numbers of a restart file cannot be those that pack writes of n records
  static void check(int64_t n, RestartNumbers &packed)
  {
    for (; n > 0; n--) {
      packed.skip_id();
      packed.next(Memory::finite);
      for (int k = Memory::finite; k < Memory::size; k++)
        if (std::isnan(*packed.bits(1))) packed.damaged();
    }
  }

  double memory_usage() const    // [bytes]
  {
    return last.capacity() * sizeof(int) + records.capacity() * sizeof(Record);
  }

 private:
  static constexpr int none = -1;
  struct Record {
    Memory memory;        // as the first of the two atoms sees it
    tagint partner[2];    // of each
    int before[2];        // link to the next of the same atom
  };
  std::vector<Record> records;
  std::vector<int> last;    // link to the newest of each atom: twice the record + which of the two
  bool in_plane = false;

  int before(int link) const { return records[link / 2].before[link % 2]; }
  tagint partner_of(int link) const { return records[link / 2].partner[link % 2]; }
  Memory seen(int link) const
  {
    const Memory &memory = records[link / 2].memory;
    return link % 2 ? memory.swapped(in_plane) : memory;
  }

  void forget_all() { std::fill(last.begin(), last.end(), none); }
};

}    // namespace LAMMPS_NS

#endif
