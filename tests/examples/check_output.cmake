# Fails unless a program prints exactly the first ```text block after its source is named in a document.
#   cmake -DPROGRAM=… -DSOURCE=apps/examples/01_….cpp -DDOCUMENT=docs/examples.md -P check_output.cmake
# WORKING_DIRECTORY, if set, is where the program runs.
cmake_minimum_required(VERSION 3.25)

if(NOT WORKING_DIRECTORY)
  set(WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
endif()
execute_process(COMMAND "${PROGRAM}" OUTPUT_VARIABLE printed ERROR_VARIABLE complaint RESULT_VARIABLE status
                WORKING_DIRECTORY "${WORKING_DIRECTORY}")
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${status}: ${complaint}")
endif()

file(READ "${DOCUMENT}" text)
foreach(mark "${SOURCE}" "```text\n")
  string(FIND "${text}" "${mark}" start)
  if(start EQUAL -1)
    message(FATAL_ERROR "${DOCUMENT} shows no output of ${SOURCE}; it printed\n${printed}")
  endif()
  string(LENGTH "${mark}" length)
  math(EXPR start "${start} + ${length}")
  string(SUBSTRING "${text}" ${start} -1 text)
endforeach()
string(FIND "${text}" "```" end)
string(SUBSTRING "${text}" 0 ${end} shown)

if(NOT printed STREQUAL shown)
  message(FATAL_ERROR "${DOCUMENT} shows of ${SOURCE}\n${shown}\nbut it printed\n${printed}")
endif()
