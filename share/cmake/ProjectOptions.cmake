# Warnings and sanitizers of this repository's own builds.
#
# They are put on finished targets from the top level, so that a library's CMakeLists.txt carries
# none of them: configured alone, installed or included elsewhere, it builds with its user's flags.

option(FPM_WARNINGS_AS_ERRORS "Stop the build at a compiler warning" OFF)
set(FPM_SANITIZERS "" CACHE STRING
    "Sanitizers for every target, as -fsanitize= takes them, e.g. address,undefined")

# Puts the warnings, and the sanitizers if any were asked for, on one compiled target. PRIVATE:
# nothing of it reaches a consumer or an installed package.
function(fpm_apply_project_options target)
  target_compile_options(${target} PRIVATE
    $<$<COMPILE_LANG_AND_ID:CXX,GNU,Clang>:-Wall -Wextra -Wpedantic -Wconversion>)
  set_target_properties(${target} PROPERTIES COMPILE_WARNING_AS_ERROR ${FPM_WARNINGS_AS_ERRORS})
  if(FPM_SANITIZERS)
    # -O1 keeps stack traces readable and Eigen bearable; -g1 keeps the line numbers, and halves the
    # time of compilation.
    target_compile_options(${target} PRIVATE
      -fsanitize=${FPM_SANITIZERS} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
    target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
    target_link_options(${target} PRIVATE -fsanitize=${FPM_SANITIZERS})
  endif()
endfunction()

# All compiled targets made in `directory` and below it, in `out`.
function(fpm_compiled_targets out directory)
  set(found)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "^(EXECUTABLE|(STATIC|SHARED|MODULE|OBJECT)_LIBRARY)$")
      list(APPEND found ${target})
    endif()
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory IN LISTS subdirectories)
    fpm_compiled_targets(below ${subdirectory})
    list(APPEND found ${below})
  endforeach()
  set(${out} ${found} PARENT_SCOPE)
endfunction()
