// The contact law without vectors, blocks and fused products: contact by contact, in doubles. What
// every build of the kernel must agree with.

#ifndef APF_TEST_SCALAR_KERNEL_H
#define APF_TEST_SCALAR_KERNEL_H

#include "contact/contact_kernel.h"

namespace apf_test {

apf::ContactKernel scalar_kernel(const apf::KernelChoice &choice);

}    // namespace apf_test

#endif
