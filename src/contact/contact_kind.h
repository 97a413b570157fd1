// Contacts between bodies of the same size, mass and material are of one kind: their constants cost
// a dozen roots and powers, and are looked up where the same kind was met before.

#ifndef APF_CONTACT_KIND_H
#define APF_CONTACT_KIND_H

#include "contact_model.h"
#include "stiffness.h"

#include <cstdint>
#include <cstring>
#include <vector>

namespace apf {

struct ContactKind {
  ContactConstants constants;
  StiffestMode mode;

  static ContactKind make(const ContactModel &model, const ContactBodies &bodies)
  {
    return {ContactConstants::make(model, bodies), stiffest_mode(model, bodies)};
  }
};

// Direct-mapped: a kind that falls on the place of another replaces it.
class ContactKinds {
 public:
  // the kind of a contact under the law of that number; the reference holds until the next call
  const ContactKind &find(int law, const ContactModel &model, const ContactBodies &bodies)
  {
    Place &place = places[hash(law, bodies) % places.size()];
    if (place.law != law || memcmp(&place.bodies, &bodies, sizeof(bodies)) != 0)
      place = {law, bodies, ContactKind::make(model, bodies)};
    return place.kind;
  }

  void forget() { places.assign(places.size(), Place()); }    // laws have changed

 private:
  struct Place {
    int law = -1;
    ContactBodies bodies{};
    ContactKind kind{};
  };
  std::vector<Place> places = std::vector<Place>(1024);

  static uint64_t hash(int law, const ContactBodies &bodies)
  {
    uint64_t h = law, bits;
    for (const double value : {bodies.radius_i, bodies.radius_j, bodies.m, bodies.crowding}) {
      memcpy(&bits, &value, sizeof(bits));
      h = (h ^ bits) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 29;
    }
    return h;
  }
};

}    // namespace apf

#endif
