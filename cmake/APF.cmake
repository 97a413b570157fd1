# LAMMPS's Modules/Packages/APF.cmake: what package APF needs beyond the files in src/APF.
# tools/drop_in puts it there.

set(APF_SOURCE ${LAMMPS_SOURCE_DIR}/APF)
include(${CMAKE_CURRENT_LIST_DIR}/APF-core.cmake)
target_link_libraries(lammps PRIVATE apf-core apf-kernel apf-vtkhdf apf-fftw)
