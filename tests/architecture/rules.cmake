# The dependency rules, as functions over a source tree. `fpm_violations(out root)` lists every
# breach in `root` as "file: what is wrong".

# What each library may include besides the standard library, as prefixes.
set(may_include_of_jfnk "jfnk/|Eigen/")
set(may_include_of_constitutive "constitutive/|Eigen/")
set(may_include_of_fpm "fpm/|Eigen/|omp\\.h$")
# The headers in which a library may meet Boost: archives of its own state.
set(may_include_boost "^lib[a-z]+/include/[a-z]+/serialization\\.hpp$")
# The one file that sees FLANN.
set(may_include_flann "^libfpm/src/neighbour_search\\.cpp$")

# The standard headers by which a library would print or read files. <cstdio> is not among them:
# snprintf only formats.
set(never_in_a_library "iostream|fstream|syncstream|print|filesystem")
# The names, likewise, and those that end the program.
set(printing "(f|d|v|vf)?printf|put(s|char)|fput(s|c)|fwrite|fopen|freopen|perror|popen|system")
set(ending "exit|_Exit|quick_exit|abort|terminate")
set(never_called_in_a_library
    "std::c(out|err|log|in)[^a-z_]|(^|[^A-Za-z_0-9.>])(${printing}|${ending}) *\\(")

# Each third-party package that only some of apps/ may see.
set(only_in_wiring "H5|hdf5|toml\\+\\+|toml\\.hpp|spdlog/")
set(only_in_limit "Ip[A-Z]|coin/|coin-or/|CGAL/")

# The text of a source file without its comments.
function(fpm_code out file)
  file(READ ${file} text)
  string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" text "${text}")
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

# What a file includes, without brackets and quotes.
function(fpm_includes out code)
  string(REGEX MATCHALL "(^|\n)[ \t]*#[ \t]*include[ \t]*[<\"][^>\"\n]+" lines "${code}")
  set(includes)
  foreach(line IN LISTS lines)
    string(REGEX REPLACE ".*[<\"]" "" include "${line}")
    list(APPEND includes ${include})
  endforeach()
  set(${out} ${includes} PARENT_SCOPE)
endfunction()

# Is the include one that library `name` may have in `file`? Standard headers have neither folder
# nor extension; a plain "name.hpp" is private to the library's src/.
function(fpm_library_may_include out name file include)
  set(${out} FALSE PARENT_SCOPE)
  if(include MATCHES "^(${may_include_of_${name}})" OR
     (include MATCHES "^boost/" AND file MATCHES "${may_include_boost}") OR
     (include MATCHES "^flann/" AND file MATCHES "${may_include_flann}") OR
     (include MATCHES "^[a-z0-9_]+\\.hpp$" AND file MATCHES "^lib[a-z]+/src/") OR
     (include MATCHES "^[a-z0-9_]+$" AND NOT include MATCHES "^(${never_in_a_library})$"))
    set(${out} TRUE PARENT_SCOPE)
  endif()
endfunction()

# Breaches by one library's headers and sources.
function(fpm_library_violations out root name)
  set(violations)
  file(GLOB_RECURSE files RELATIVE ${root} ${root}/lib${name}/include/* ${root}/lib${name}/src/*)
  if(NOT files)
    list(APPEND violations "lib${name}: has no sources to check")
  endif()
  foreach(file IN LISTS files)
    fpm_code(code ${root}/${file})
    fpm_includes(includes "${code}")
    foreach(include IN LISTS includes)
      fpm_library_may_include(allowed ${name} ${file} ${include})
      if(NOT allowed)
        list(APPEND violations "${file}: a library may not include ${include}")
      endif()
    endforeach()
    if(code MATCHES "(${never_called_in_a_library})")
      string(REGEX REPLACE "^[^A-Za-z_]+|[^A-Za-z_]+$" "" call "${CMAKE_MATCH_1}")
      list(APPEND violations "${file}: a library may not print, read files or exit (${call})")
    endif()
  endforeach()
  set(${out} ${violations} PARENT_SCOPE)
endfunction()

# Breaches by the programs: who may see which package, and who may know whom.
function(fpm_apps_violations out root)
  set(violations)
  file(GLOB_RECURSE files RELATIVE ${root} ${root}/apps/*.hpp ${root}/apps/*.cpp)
  foreach(file IN LISTS files)
    fpm_code(code ${root}/${file})
    fpm_includes(includes "${code}")
    string(REGEX REPLACE "^apps/([^/]+)/.*" "\\1" app ${file})
    foreach(include IN LISTS includes)
      if(include MATCHES "^(${only_in_wiring})" AND NOT app STREQUAL wiring)
        list(APPEND violations "${file}: only apps/wiring may include ${include}")
      elseif(include MATCHES "^(${only_in_limit})" AND NOT app STREQUAL limit)
        list(APPEND violations "${file}: only apps/limit may include ${include}")
      elseif(include MATCHES "^flann/")
        list(APPEND violations "${file}: only libfpm may include ${include}")
      elseif(include MATCHES "^(run|info|compare|limit)/" AND NOT CMAKE_MATCH_1 STREQUAL app)
        list(APPEND violations "${file}: programs may not include each other (${include})")
      endif()
    endforeach()
  endforeach()
  set(${out} ${violations} PARENT_SCOPE)
endfunction()

# Breaches by the programs that join libraries themselves instead of asking apps/wiring.
function(fpm_joining_violations out root)
  set(violations)
  file(GLOB apps RELATIVE ${root} LIST_DIRECTORIES TRUE ${root}/apps/*)
  list(REMOVE_ITEM apps apps/wiring)
  foreach(app IN LISTS apps)
    set(met)
    file(GLOB_RECURSE files ${root}/${app}/*.hpp ${root}/${app}/*.cpp)
    foreach(file IN LISTS files)
      fpm_code(code ${file})
      fpm_includes(includes "${code}")
      list(FILTER includes INCLUDE REGEX "^(jfnk|constitutive|fpm)/")
      list(TRANSFORM includes REPLACE "/.*" "")
      list(APPEND met ${includes})
    endforeach()
    list(REMOVE_DUPLICATES met)
    list(LENGTH met count)
    if(count GREATER 1)
      list(JOIN met ", " met)
      list(APPEND violations "${app}: only apps/wiring may join libraries (${met})")
    endif()
  endforeach()
  set(${out} ${violations} PARENT_SCOPE)
endfunction()

# Breaches by any file, whichever part it belongs to.
function(fpm_common_violations out root)
  set(violations)
  foreach(part libjfnk libconstitutive libfpm apps tests)
    file(GLOB_RECURSE files RELATIVE ${root} ${root}/${part}/*.hpp ${root}/${part}/*.cpp)
    foreach(file IN LISTS files)
      fpm_code(code ${root}/${file})
      fpm_includes(includes "${code}")
      foreach(include IN LISTS includes)
        if(include MATCHES "^(/|.*\\.\\./)")
          list(APPEND violations "${file}: includes by a path, not by a name (${include})")
        endif()
      endforeach()
      # Formatted sources indent only what stands in a function, where it harms no includer.
      if(file MATCHES "\\.hpp$" AND
         code MATCHES "(^|\n)using[ \t\n]+namespace[ \t\n]+([a-zA-Z_:]+)")
        list(APPEND violations "${file}: using namespace ${CMAKE_MATCH_2} in a header")
      endif()
    endforeach()
  endforeach()
  set(${out} ${violations} PARENT_SCOPE)
endfunction()

function(fpm_violations out root)
  set(violations)
  foreach(name jfnk constitutive fpm)
    fpm_library_violations(found ${root} ${name})
    list(APPEND violations ${found})
  endforeach()
  fpm_apps_violations(found ${root})
  list(APPEND violations ${found})
  fpm_joining_violations(found ${root})
  list(APPEND violations ${found})
  fpm_common_violations(found ${root})
  list(APPEND violations ${found})
  set(${out} ${violations} PARENT_SCOPE)
endfunction()
