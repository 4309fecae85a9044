# cmake -DROOT=<source tree> -P check_words.cmake
#
# Words of another age of the language, which clang-tidy would take a tenth of its time to find.
cmake_minimum_required(VERSION 3.25)

set(files_seen 0)
foreach(part libjfnk libconstitutive libfpm apps tests)
  file(GLOB_RECURSE files ${ROOT}/${part}/*.hpp ${ROOT}/${part}/*.cpp)
  foreach(file IN LISTS files)
    file(STRINGS ${file} lines REGEX "(^|[ \t{};])typedef[ \t]|(^|[^A-Za-z_\"])NULL($|[^A-Za-z_\"])")
    foreach(line IN LISTS lines)
      message(SEND_ERROR "${file}: ${line}\n  write `using`, or nullptr")
    endforeach()
    math(EXPR files_seen "${files_seen} + 1")
  endforeach()
endforeach()
if(files_seen EQUAL 0)
  message(FATAL_ERROR "no sources found in ${ROOT}")
endif()
