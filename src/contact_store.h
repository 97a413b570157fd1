// Contacts and liquid bridges kept with the particles they belong to, while particles change index,
// rank or run: lists of contacts hold rows that a rebuild makes invalid, this store holds partner
// IDs. Pair style and walls use it alike (a wall's partner ID is the number of its surface).
// It holds them only until forces are computed again; liquid stays.

#ifndef APF_CONTACT_STORE_H
#define APF_CONTACT_STORE_H

#include "contact/bridge_list.h"
#include "contact/contact_list.h"
#include "partner_records.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace LAMMPS_NS {

class ContactStore {
 public:
  PartnerRecords<apf::ContactHistory> contacts;
  PartnerRecords<apf::BridgeMemory> bridges;

  void grow(int n)
  {
    if (n <= static_cast<int>(owners.size())) return;
    contacts.grow(n);
    bridges.grow(n);
    owners.resize(n, 0);
    if (keeps_liquid()) liquid.resize(n, NAN);
  }
  void clear(int i)
  {
    contacts.clear(i);
    bridges.clear(i);
    owners[i] = 0;
  }
  // all anew, for that many atoms, with room for records of so many contacts and bridges
  void start(int atoms, size_t of_contacts, size_t of_bridges, bool planar)
  {
    grow(atoms);
    contacts.start(of_contacts, planar);
    bridges.start(of_bridges, planar);
    std::fill(owners.begin(), owners.end(), 0);
  }
  void release()
  {
    contacts.release();
    bridges.release();
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

  // an error where numbers of a restart file cannot be those that pack writes
  static void check(RestartNumbers &packed)
  {
    const auto what = static_cast<int64_t>(packed.whole(0.0, 2.0 * with_liquid));
    packed.skip_id();
    if (what >= with_liquid && std::isinf(*packed.bits(1))) packed.damaged();
    PartnerRecords<apf::ContactHistory>::check(what % with_liquid % per_bridge, packed);
    PartnerRecords<apf::BridgeMemory>::check(what % with_liquid / per_bridge, packed);
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
