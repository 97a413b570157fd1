# Libraries apf-core, apf-kernel, apf-vtkhdf and apf-fftw: what APF needs beside LAMMPS.
# APF_SOURCE: its src.

# ---- core: no LAMMPS header
add_library(apf-core INTERFACE)
target_include_directories(apf-core INTERFACE ${APF_SOURCE})
target_compile_features(apf-core INTERFACE cxx_std_17)
target_compile_options(apf-core INTERFACE -Wall -Wextra)

# ---- contact kernel and sampler of gridded flows: the places that need vector code, built for
# several instruction sets and chosen at run time. No -ffast-math: the options only say that errno and
# floating-point traps are not looked at, and that products may be fused with sums. Templates and inline functions get names of their
# own per copy (namespace, size of a register), so the linker cannot mix the copies up.
set(kernel_options -fno-math-errno -fno-trapping-math -ffp-contract=fast -Wno-psabi
  $<$<NOT:$<CONFIG:Debug>>:-O3>)
add_library(apf-kernel STATIC ${APF_SOURCE}/contact/kernel_dispatch.cpp
  ${APF_SOURCE}/contact/instruction_set.cpp ${APF_SOURCE}/flow/grid_records.cpp)
target_link_libraries(apf-kernel PUBLIC apf-core)
set_target_properties(apf-kernel PROPERTIES POSITION_INDEPENDENT_CODE ON)
function(add_kernel isa)
  add_library(apf-kernel-${isa} OBJECT ${APF_SOURCE}/contact/contact_kernel.cpp
    ${APF_SOURCE}/contact/bridge_kernel.cpp
    ${APF_SOURCE}/flow/grid_sampler.cpp ${APF_SOURCE}/flow/fluid_forces.cpp
    ${APF_SOURCE}/flow/lane_rows.cpp)
  target_link_libraries(apf-kernel-${isa} PRIVATE apf-core)
  target_compile_definitions(apf-kernel-${isa} PRIVATE APF_ISA=${isa})
  target_compile_options(apf-kernel-${isa} PRIVATE ${kernel_options} ${ARGN})
  set_target_properties(apf-kernel-${isa} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_sources(apf-kernel PRIVATE $<TARGET_OBJECTS:apf-kernel-${isa}>)
endfunction()
add_kernel(baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_kernel(avx2 -mavx2 -mfma)
  add_kernel(avx512 -mavx2 -mfma -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512)
  target_compile_definitions(apf-kernel PRIVATE APF_X86)
endif()

# ---- files of flows: VTKHDF by HDF5's C library
find_package(HDF5 REQUIRED COMPONENTS C)
add_library(apf-vtkhdf STATIC ${APF_SOURCE}/flow/vtkhdf_file.cpp)
target_link_libraries(apf-vtkhdf PUBLIC apf-core PRIVATE ${HDF5_C_LIBRARIES}
  PUBLIC $<$<PLATFORM_ID:Linux>:rt>)    # timer_create of glibc before 2.34, for those who read files
target_include_directories(apf-vtkhdf SYSTEM PRIVATE ${HDF5_C_INCLUDE_DIRS})
target_compile_definitions(apf-vtkhdf PRIVATE ${HDF5_C_DEFINITIONS})
set_target_properties(apf-vtkhdf PROPERTIES POSITION_INDEPENDENT_CODE ON)

# ---- fix flow/concentration method fft; without FFTW for this MPI its clouds are summed directly
option(APF_FFTW "Look for FFTW with MPI, for fix flow/concentration" ON)
add_library(apf-fftw INTERFACE)
find_path(APF_FFTW_INCLUDE_DIR fftw3-mpi.h)
find_library(APF_FFTW_MPI_LIBRARY fftw3_mpi)
find_library(APF_FFTW_LIBRARY fftw3)
if(APF_FFTW AND BUILD_MPI AND APF_FFTW_INCLUDE_DIR AND APF_FFTW_MPI_LIBRARY AND APF_FFTW_LIBRARY)
  target_compile_definitions(apf-fftw INTERFACE APF_FFTW)
  target_include_directories(apf-fftw SYSTEM INTERFACE ${APF_FFTW_INCLUDE_DIR})
  target_link_libraries(apf-fftw INTERFACE ${APF_FFTW_MPI_LIBRARY} ${APF_FFTW_LIBRARY})
else()
  set(APF_FFTW OFF)
  message(STATUS "No FFTW for MPI: fix flow/concentration has no method fft")
endif()
