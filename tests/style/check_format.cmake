# cmake -DROOT=<source tree> -DCLANG_FORMAT=<program> -P check_format.cmake
cmake_minimum_required(VERSION 3.25)

set(files)
foreach(part libjfnk libconstitutive libfpm apps tests)
  file(GLOB_RECURSE found ${ROOT}/${part}/*.hpp ${ROOT}/${part}/*.cpp)
  list(APPEND files ${found})
endforeach()
if(NOT files)
  message(FATAL_ERROR "no sources found in ${ROOT}")
endif()
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror --style=file ${files}
                RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "format with: ${CLANG_FORMAT} -i <files>")
endif()
