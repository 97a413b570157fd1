// The fluid's velocity and vorticity as functions of position, one of several kinds. A kind is a
// struct with velocity(x) and vorticity(x), x the three coordinates; loops over particles choose
// the kind once (std::visit) and call it without any further branch. A new kind is added here.

#ifndef APF_FLOW_FIELD_H
#define APF_FLOW_FIELD_H

#include "channel_flow.h"
#include "pipe_flow.h"
#include "shear_flow.h"
#include "uniform_flow.h"

#include <variant>

namespace apf {

using FlowField = std::variant<UniformFlow, ShearFlow, ChannelFlow, PipeFlow>;

}    // namespace apf

#endif
