# The warning set is private to this build: nothing here reaches a consumer.
# (-Wrestrict of g++ 12 warns of its own std::string, bug 105651.)
function(sigmax_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wimplicit-fallthrough
    $<$<CXX_COMPILER_ID:Clang>:-Wreserved-identifier>
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op -Wuseless-cast -Wno-restrict>
    $<$<BOOL:${SIGMAX_WERROR}>:-Werror>)
endfunction()
option(SIGMAX_WERROR "Treat warnings as errors (CI does)" OFF)

# Most of what compiling takes is headers, so a few files are compiled as one; off while one file is being worked at. Files
# with options of their own stay alone.
option(SIGMAX_UNITY "Compile several files as one" ON)
function(sigmax_unity target files)
  if(SIGMAX_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${files})
  endif()
endfunction()

# sigmax_room(NAME [PART] [SOURCES …] [DEPENDS …]): the library sigmax::NAME of one room, with its own include root. All
# headers below it are the room's file set: they are installed, and each must compile alone (scripts/headers). A PART needs what
# the others do without: its users name it as a component, and sigmax::sigmax leaves it out.
function(sigmax_room name)
  cmake_parse_arguments(ROOM "PART" "" "SOURCES;DEPENDS" ${ARGN})
  set(target sigmax_${name})
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    set(scope PUBLIC)
    sigmax_warnings(${target})
    sigmax_unity(${target} 3)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(sigmax::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_20)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS include/*.hpp)
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS include FILES ${headers})
  target_link_libraries(${target} ${scope} ${ROOM_DEPENDS})
  if(ROOM_PART)
    sigmax_install(${target} sigmax-${name})
    set_property(GLOBAL APPEND PROPERTY sigmax_parts ${name})
  else()
    sigmax_install(${target} sigmax)
  endif()
endfunction()

# sigmax_install(TARGET EXPORT): puts a library into the CMake package; does nothing inside another project.
function(sigmax_install target export)
  if(SIGMAX_INSTALL)
    install(TARGETS ${target} EXPORT ${export} ARCHIVE COMPONENT dev FILE_SET HEADERS COMPONENT dev)
    add_dependencies(sigmax_installed ${target})
    if(export STREQUAL sigmax)
      set_property(GLOBAL APPEND PROPERTY sigmax_installed_libraries ${target})
    endif()
  endif()
endfunction()

# sigmax_program(NAME LIBRARIES …): all .cpp in NAME as one program, which is installed with completion by bash; with a manual
# page made of its --help where there is help2man.
function(sigmax_program name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${name}/*.cpp)
  add_executable(${name} ${sources})
  sigmax_warnings(${name})
  sigmax_unity(${name} 3)
  target_link_libraries(${name} PRIVATE ${ARGN})
  if(SIGMAX_INSTALL)
    install(TARGETS ${name} RUNTIME COMPONENT tools)
    install(FILES completion.bash DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME ${name}
            COMPONENT tools)
    add_dependencies(sigmax_installed ${name})
    find_program(HELP2MAN help2man)
    if(HELP2MAN)
      add_custom_command(OUTPUT ${name}.1.gz DEPENDS ${name} VERBATIM
                         COMMAND "${HELP2MAN}" --no-info "--name=sigma-max inference" --output=${name}.1 $<TARGET_FILE:${name}>
                         COMMAND gzip -9nf ${name}.1)
      add_custom_target(${name}_manual ALL DEPENDS ${name}.1.gz)
      install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}.1.gz" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT tools)
      add_dependencies(sigmax_installed ${name}_manual)
    else()
      message(STATUS "help2man was not found, so ${name} is installed without its manual page")
    endif()
  endif()
endfunction()

add_custom_target(sigmax_installed)  # all that `cmake --install` wants, and no more
