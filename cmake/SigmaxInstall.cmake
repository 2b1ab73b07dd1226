# What `cmake --install` adds to the libraries and programs: the CMake package, files for pkg-config, and Debian packages by CPack.
# Components: dev (to link the library), tools (the programs) and python (if it is built). Nothing installed holds an absolute path.
include(CMakePackageConfigHelpers)

sigmax_install(sigmax_all sigmax)
set(SIGMAX_WITH_HIGHWAY FALSE)  # whether users of the static library have to link Highway
if(TARGET hwy::hwy)
  set(SIGMAX_WITH_HIGHWAY TRUE)
endif()
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/sigmax")
install(EXPORT sigmax NAMESPACE sigmax:: FILE sigmax-targets.cmake DESTINATION "${package_dir}" COMPONENT dev)
get_property(SIGMAX_PARTS GLOBAL PROPERTY sigmax_parts)
foreach(part IN LISTS SIGMAX_PARTS)
  install(EXPORT sigmax-${part} NAMESPACE sigmax:: FILE sigmax-${part}-targets.cmake DESTINATION "${package_dir}" COMPONENT dev)
endforeach()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/sigmax-config.cmake.in" sigmax-config.cmake
                              INSTALL_DESTINATION "${package_dir}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(sigmax-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/sigmax-config.cmake" "${CMAKE_CURRENT_BINARY_DIR}/sigmax-config-version.cmake"
        DESTINATION "${package_dir}" COMPONENT dev)

file(RELATIVE_PATH prefix_from_pc "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
get_property(libraries GLOBAL PROPERTY sigmax_installed_libraries)
set(link_flags "")
foreach(library IN LISTS libraries)
  get_target_property(type ${library} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    string(PREPEND link_flags " -l${library}")  # rooms are added before those that need them
  endif()
endforeach()
# sigmax_pc(NAME PART REQUIRES LIBRARIES): NAME.pc
function(sigmax_pc pc_name pc_part pc_requires pc_libraries)
  configure_file("${SIGMAX_PC_IN}" ${pc_name}.pc @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${pc_name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
endfunction()
set(SIGMAX_PC_IN "${CMAKE_CURRENT_LIST_DIR}/sigmax.pc.in")
set(private_flags "")
if(SIGMAX_WITH_HIGHWAY)
  set(private_flags " -lhwy")
endif()
sigmax_pc(sigmax "" "eigen3 >= 3.4" "${link_flags}${private_flags}")
sigmax_pc(sigmax-core ": the part that does without Eigen" "" " -lsigmax_core${private_flags}")
set(parts_need "")  # of Debian's packages
foreach(part IN LISTS SIGMAX_PARTS)  # SIGMAX_NEEDS is the library of each, for a linker, and Debian's package of it
  get_target_property(needs sigmax_${part} SIGMAX_NEEDS)
  list(POP_FRONT needs library)
  sigmax_pc(sigmax-${part} ": the part ${part}" "sigmax" " -lsigmax_${part} -l${library}")
  string(APPEND parts_need ", ${needs}")
  if(EXISTS "${CMAKE_CURRENT_LIST_DIR}/Find${library}.cmake")
    install(FILES "${CMAKE_CURRENT_LIST_DIR}/Find${library}.cmake" DESTINATION "${package_dir}" COMPONENT dev)
  endif()
endforeach()

# Debian packages: `cpack -G DEB` in the build directory. What Debian wants in every package is installed in packages only.
set(packages libsigmax-dev:dev sigmax-tools:tools)
if(SIGMAX_PYTHON)
  list(APPEND packages python3-sigmax:python)
endif()
foreach(package IN LISTS packages)
  string(REPLACE ":" ";" package "${package}")
  list(POP_FRONT package name component)
  set(doc "${CMAKE_INSTALL_DATAROOTDIR}/doc/${name}")
  install(FILES "${CMAKE_CURRENT_LIST_DIR}/debian/copyright" DESTINATION "${doc}" COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/debian/changelog.gz" DESTINATION "${doc}" COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
configure_file("${CMAKE_CURRENT_LIST_DIR}/debian/changelog.in" debian/changelog @ONLY)
execute_process(COMMAND gzip -9nk -f "${CMAKE_CURRENT_BINARY_DIR}/debian/changelog" COMMAND_ERROR_IS_FATAL ANY)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "sigmax")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL dev tools)
if(SIGMAX_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "sigmax maintainers <maintainers@sigmax.invalid>")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libsigmax-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4), libstdc++-12-dev | libstdc++-dev${parts_need}")
if(SIGMAX_WITH_HIGHWAY)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libhwy-dev")
endif()
set(CPACK_COMPONENT_DEV_DESCRIPTION "sigma-max inference: probability and possibility, for C++20
Sums for random variables, maxima for fuzzy ones: relations, networks, a
sequential classifier, Kalman filters, and one interacting multiple-model
filter, which is the IMM if its mode is random and the HIMM if it is fuzzy.
.
This package holds the headers, the static libraries, and the files for CMake
and pkg-config.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME sigmax-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "tracking and recognition by probability and possibility
The programs of sigmax, a library of sigma-max inference. himm_demo compares
the interacting multiple-model filter with a random and with a fuzzy mode, on
simulated targets and on recorded flights. recognition_demo learns to recognise
targets from sequences of reports, by probability and by possibility.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-sigmax)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas, python3-matplotlib, python3-sklearn")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "sigma-max inference: probability and possibility, for Python
Sums for random variables, maxima for fuzzy ones: relations, networks, a
sequential classifier, and the interacting multiple-model filter. Arrays of
NumPy in, arrays out.")
include(CPack)
