// Reads one material from a material file such as potentials/materials.adhesive.
//
//   # DATE: 2026-11-22 UNITS: si CONTRIBUTOR: ... CITATION: ...
//   # NAME   E[Pa]  nu[-]  gamma[J/m^2]
//   silica   72.2e9 0.167  0.020
//
// The file is looked for as LAMMPS looks for potentials: the path as given, then its last part in
// the folders of LAMMPS_POTENTIALS.

#ifndef APF_MATERIAL_FILE_H
#define APF_MATERIAL_FILE_H

#include "contact/material.h"
#include "error.h"

#include <string>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace apf {

// The material in the units of the simulation: si, cgs, micro or nano; other units are an error.
// Collective: every rank calls it and gets the same material, or every rank throws the same error.
//   caller   begins the error texts: "Pair granular/adhesive"
//   iarg     which argument of the command is FILE; errors point at it, or at NAME, the next one
Material read_material(LAMMPS_NS::LAMMPS *lmp, const std::string &file, const std::string &name,
                       const char *caller, int iarg = LAMMPS_NS::Error::NOPOINTER);

}    // namespace apf

#endif
