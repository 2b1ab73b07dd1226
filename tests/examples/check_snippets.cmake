# Fails unless every ```cpp block of a document is code of a test, in which the values it claims are checked.
#   cmake -DDOCUMENT=docs/algebra.md -DTEST=tests/core/algebra_walk_test.cpp -P check_snippets.cmake
# Indentation, comments and line breaks inside a statement may differ.
cmake_minimum_required(VERSION 3.25)

function(plain_code text result)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "[ \n]+" " " text "${text}")
  string(STRIP "${text}" text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

file(READ "${DOCUMENT}" rest)
file(READ "${TEST}" test)
plain_code("${test}" test)

set(blocks 0)
while(TRUE)
  string(FIND "${rest}" "```cpp\n" start)
  if(start EQUAL -1)
    break()
  endif()
  math(EXPR start "${start} + 7")
  string(SUBSTRING "${rest}" ${start} -1 rest)
  string(FIND "${rest}" "```" end)
  string(SUBSTRING "${rest}" 0 ${end} block)
  math(EXPR end "${end} + 3")
  string(SUBSTRING "${rest}" ${end} -1 rest)
  plain_code("${block}" code)
  string(FIND "${test}" "${code}" found)
  if(found EQUAL -1)
    message(SEND_ERROR "${DOCUMENT} shows code that ${TEST} does not have:\n${block}")
  endif()
  math(EXPR blocks "${blocks} + 1")
endwhile()

if(blocks EQUAL 0)
  message(SEND_ERROR "${DOCUMENT} has no code block")
endif()
