# Installs the build into a folder of its own, and its Debian package into another; lmp must load the
# plugin of each and know its styles.
#   cmake -D BUILD=folder -D LMP=lmp -P install.cmake

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(failed)
    message(FATAL_ERROR "${ARGN}: ${failed}\n${said}")
  endif()
endfunction()

function(expect_installed root)
  file(GLOB_RECURSE plugins ${root}/apfplugin.so)
  foreach(name materials.adhesive contact/jkr.h apf_advise.rst CITATION.cff LICENSE)
    file(GLOB_RECURSE all ${root}/*)
    if(NOT "${all}" MATCHES "/${name}")
      message(FATAL_ERROR "${name} is not below ${root}")
    endif()
  endforeach()
  file(WRITE ${root}/in.load "plugin load ${plugins}\npair_style granular/adhesive\n")
  run(${CMAKE_COMMAND} -E env --unset=LAMMPS_PLUGIN_PATH ${LMP} -in ${root}/in.load -log none)
endfunction()

set(scratch ${BUILD}/install-test)
file(REMOVE_RECURSE ${scratch})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${scratch}/prefix)
expect_installed(${scratch}/prefix)

find_program(DPKG dpkg-deb)
if(NOT DPKG)
  message("no dpkg-deb: the Debian package is not tested")
  return()
endif()
get_filename_component(bin ${CMAKE_COMMAND} DIRECTORY)
run(${bin}/cpack -G DEB --config ${BUILD}/CPackConfig.cmake -B ${scratch}/packages)
file(GLOB package ${scratch}/packages/*.deb)
run(${DPKG} -x ${package} ${scratch}/root)
expect_installed(${scratch}/root)
