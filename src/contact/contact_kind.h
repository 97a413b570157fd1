// Contacts between bodies of the same size, mass and material are of one kind, and so are their
// bridges: constants cost a dozen roots and powers, and are looked up where the same kind was met
// before.

#ifndef APF_CONTACT_KIND_H
#define APF_CONTACT_KIND_H

#include "contact_model.h"
#include "stiffness.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace apf {

struct ContactKind {
  struct Rest {
    double crowd_mass, crowd_roll;    // of ContactConstants
    StiffestMode mode;
  };
  ConstantsOf<double> constants;
  Rest rest;

  ContactKind(const ContactConstants &c, const StiffestMode &mode) :
      constants(c), rest{c.crowd_mass, c.crowd_roll, mode}
  {
  }
  static ContactKind make(const ContactModel &model, const ContactBodies &bodies)
  {
    return {ContactConstants::make(model, bodies), stiffest_mode(model, bodies)};
  }
};

// The kinds in use, each with the number of its contacts, and the last one met at each place of a
// hash. A kind that was pushed from there while it has contacts may be in here twice. A Kind is
// what kernels read, `constants`, and the `rest`.
template <class Kind> class Kinds {
 public:
  const auto &constants(int n) const { return rows[n].constants; }
  const auto &operator[](int n) const { return entries[n].rest; }

  // number of the kind of a contact under the law of that number; without use() it holds until the
  // next call
  template <class Model> int find(int law, const Model &model, const ContactBodies &bodies)
  {
    const uint64_t key = hash(law, bodies);
    int &n = recent[key % recent.size()];
    if (n >= 0 && entries[n].key == key) return n;
    if (n < 0 || entries[n].contacts > 0) n = place();
    return set(n, key, Kind::make(model, bodies));
  }

  // one that nobody is to find
  int add(const Kind &kind) { return set(place(), 0, kind); }

  void use(int n) { entries[n].contacts++; }
  void release(int n)
  {
    if (--entries[n].contacts == 0 && !found(n)) free.push_back(n);
  }
  void release_all()
  {
    for (auto &entry : entries) entry.contacts = 0;
    find_free();
  }

  void forget()    // laws have changed
  {
    recent.assign(recent.size(), -1);
    find_free();
  }

  double memory_usage() const    // [bytes]
  {
    return entries.capacity() * (sizeof(Entry) + sizeof(Row)) +
        (free.capacity() + recent.size()) * sizeof(int);
  }

 private:
  // Side by side in cache lines of their own: where all radii differ, kernels fetch more of these
  // than of anything else.
  struct alignas(64) Row {
    decltype(Kind::constants) constants;
  };
  struct Entry {
    uint64_t key;    // hash of law and bodies: 64 bits, compared with those of one place only
    decltype(Kind::rest) rest;
    int contacts;
  };
  std::vector<Row> rows;    // as many as entries
  std::vector<Entry> entries;
  std::vector<int> free;                                   // entries that nobody finds or uses
  std::vector<int> recent = std::vector<int>(1024, -1);    // by hash: which entry was the last

  int set(int n, uint64_t key, const Kind &kind)
  {
    rows[n] = {kind.constants};
    entries[n] = {key, kind.rest, 0};
    return n;
  }
  bool found(int n) const { return recent[entries[n].key % recent.size()] == n; }
  void find_free()
  {
    free.clear();
    for (int n = 0; n < static_cast<int>(entries.size()); n++)
      if (entries[n].contacts == 0 && !found(n)) free.push_back(n);
  }
  int place()
  {
    if (free.empty()) {
      rows.emplace_back();
      entries.emplace_back();
      return static_cast<int>(entries.size()) - 1;
    }
    const int n = free.back();
    free.pop_back();
    return n;
  }

  static uint64_t hash(int law, const ContactBodies &bodies)
  {
    constexpr int n = sizeof(ContactBodies) / sizeof(uint64_t);
    static_assert(sizeof(ContactBodies) % sizeof(uint64_t) == 0, "doubles only");
    uint64_t bits[n], h = law;
    memcpy(bits, &bodies, sizeof(bodies));
    for (const uint64_t value : bits) {
      h = (h ^ value) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 29;
    }
    return h;
  }
};

using ContactKinds = Kinds<ContactKind>;

}    // namespace apf

#endif
