# The warning set is private to this build: nothing here reaches a consumer.
# (-Wrestrict of g++ 12 warns of its own std::string, bug 105651.)
function(sigmax_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
    -Woverloaded-virtual -Wcast-align -Wimplicit-fallthrough
    $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op -Wuseless-cast -Wno-restrict>
    $<$<BOOL:${SIGMAX_WERROR}>:-Werror>)
endfunction()
option(SIGMAX_WERROR "Treat warnings as errors (CI does)" OFF)

# sigmax_room(NAME [SOURCES …] [DEPENDS …]): the library sigmax::NAME of one room, with its own include root.
function(sigmax_room name)
  cmake_parse_arguments(ROOM "" "" "SOURCES;DEPENDS" ${ARGN})
  set(target sigmax_${name})
  if(ROOM_SOURCES)
    add_library(${target} STATIC ${ROOM_SOURCES})
    set(scope PUBLIC)
    sigmax_warnings(${target})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(sigmax::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>")
  target_link_libraries(${target} ${scope} ${ROOM_DEPENDS})
endfunction()
