// Where LAMMPS 4 Feb 2025 and 4 Jul 2026 differ.

#ifndef APF_LAMMPS_VERSION_H
#define APF_LAMMPS_VERSION_H

#if __has_include("graphics.h")
#include "graphics.h"
#else
namespace LAMMPS_NS::Graphics {
enum { SPHERE, LINE, TRI };    // as dump_image.cpp of 4 Feb 2025 numbers them
}
#endif

#endif
