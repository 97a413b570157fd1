// The fluid as a function of position, one of several kinds. A kind is a struct with velocity(x)
// and gradient(x), x the three coordinates, that is linear in its speed; the kind is chosen once
// for a block of particles. A new kind is added here. Flows given by numbers on a grid are in
// grid_flow.h.

#ifndef APF_FLOW_FIELD_H
#define APF_FLOW_FIELD_H

#include "channel_flow.h"
#include "pipe_flow.h"
#include "shear_flow.h"
#include "uniform_flow.h"

#include <variant>

namespace apf {

using FlowField = std::variant<UniformFlow, ShearFlow, ChannelFlow, PipeFlow>;

inline void sample(const FlowField &flow, const PointBlock &points, Detail detail, FluidBlock &out)
{
  std::visit(
      [&](const auto &kind) {
        sample_pointwise(kind, points, detail, out);
      },
      flow);
}

inline void sample_velocity(const FlowField &flow, const PointBlock &points, Lanes (&out)[3])
{
  std::visit(
      [&](const auto &kind) {
        sample_velocity(kind, points, out);
      },
      flow);
}

}    // namespace apf

#endif
