#include "flow_feedback.h"

using namespace LAMMPS_NS;

FlowFeedback::FlowFeedback(LAMMPS *lmp, Fix *owner, const std::array<int, 3> &cells) :
    grid(lmp, owner, cells, 3)
{
  set_up();
}

bool FlowFeedback::add(const double *x, const apf::Vec3 &force)
{
  int base[3];
  double weight[8];
  if (!grid.trilinear(x, base, weight)) return false;
  for (int k = 0; k < (grid.dimension() == 2 ? 4 : 8); k++) {
    double *to =
        grid.at(k & 1 ? grid.next(0, base[0]) : base[0], k & 2 ? grid.next(1, base[1]) : base[1],
                k & 4 ? grid.next(2, base[2]) : base[2]);
    const double share = -weight[k] / grid.cell_volume;
    to[0] += share * force.x;
    to[1] += share * force.y;
    to[2] += share * force.z;
  }
  return true;
}

void FlowFeedback::end()
{
  grid.sum_ghosts();
  grid.fill_ghosts();
}

apf::Vec3 FlowFeedback::sum()
{
  apf::Vec3 total{0.0, 0.0, 0.0};
  grid.for_own([&](const double *b) {
    total = total + grid.cell_volume * apf::Vec3{b[0], b[1], b[2]};
  });
  return total;
}
