# cmake -DROOT=<source tree> -P check.cmake: fails with a list of the breaches, if any.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/rules.cmake)

fpm_violations(violations ${ROOT})
if(violations)
  list(JOIN violations "\n  " lines)
  message(FATAL_ERROR "the dependency rules are broken:\n  ${lines}")
endif()
