// The laws of contacts and of bridges without vectors, blocks and fused products: one by one, in
// doubles. What every build of the kernels must agree with.

#ifndef APF_TEST_SCALAR_KERNEL_H
#define APF_TEST_SCALAR_KERNEL_H

#include "contact/bridge_kernel.h"
#include "contact/contact_kernel.h"

namespace apf_test {

apf::ContactKernel scalar_kernel(const apf::KernelChoice &choice);
apf::BridgeKernel scalar_bridges(const apf::BridgeChoice &choice);

}    // namespace apf_test

#endif
