# cmake -DWORK=<scratch folder> -P check_the_check.cmake: plants one breach at a time in a small
# tree and asks the rules for exactly that one; what is allowed must pass.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/rules.cmake)

# A tree with a file for each thing that is allowed.
function(make_clean_tree)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/libjfnk/include/jfnk/gmres.hpp
       "// never #include <fpm/kernel.hpp> here\n#include <Eigen/Core>\n#include <vector>\n"
       "/* using namespace std; std::cout */\n#include \"jfnk/options.hpp\"\n"
       "inline void f() {\n  using namespace std;\n}\n")
  file(WRITE ${WORK}/libjfnk/src/gmres.cpp "#include \"krylov_basis.hpp\"\n")
  file(WRITE ${WORK}/libconstitutive/include/constitutive/serialization.hpp
       "#include <boost/serialization/nvp.hpp>\n")
  file(WRITE ${WORK}/libfpm/src/neighbour_search.cpp
       "#include <flann/flann.hpp>\n#include <cstdio>\n"
       "void exit_ball(); void on_exit (int); void f() { std::snprintf(nullptr, 0, \"\"); }\n")
  file(WRITE ${WORK}/apps/wiring/checkpoint.cpp
       "#include <H5Cpp.h>\n#include <toml++/toml.h>\n#include <spdlog/spdlog.h>\n"
       "#include \"fpm/kernel.hpp\"\n#include \"jfnk/gmres.hpp\"\nusing namespace std;\n")
  file(WRITE ${WORK}/apps/run/main.cpp "#include <iostream>\n#include \"run/run_scene.hpp\"\n")
  file(WRITE ${WORK}/apps/limit/main.cpp "#include <coin/IpTNLP.hpp>\n")
endfunction()

function(expect_exactly expected what)
  fpm_violations(found ${WORK})
  if(NOT "${found}" STREQUAL "${expected}")
    message(SEND_ERROR "${what}: expected '${expected}', found '${found}'")
  endif()
endfunction()

# plant FILE TEXT EXPECTED: appended to the clean tree, the text must be found and named.
function(plant file text expected)
  make_clean_tree()
  file(APPEND ${WORK}/${file} "${text}")
  expect_exactly("${file}: ${expected}" "planted in ${file}")
endfunction()

make_clean_tree()
expect_exactly("" "the clean tree")

# The libraries know neither each other, nor the programs, nor any package but their own.
set(in_jfnk libjfnk/src/gmres.cpp)
set(in_constitutive libconstitutive/include/constitutive/elastic.hpp)
set(in_fpm libfpm/include/fpm/kernel.hpp)
plant(${in_jfnk} "#include <fpm/kernel.hpp>\n" "a library may not include fpm/kernel.hpp")
plant(${in_jfnk} "  #  include \"constitutive/elastic.hpp\"\n"
      "a library may not include constitutive/elastic.hpp")
plant(${in_constitutive} "#include <jfnk/gmres.hpp>" "a library may not include jfnk/gmres.hpp")
plant(${in_constitutive} "#include <fpm/types.hpp>" "a library may not include fpm/types.hpp")
plant(${in_fpm} "#include \"jfnk/gmres.hpp\"" "a library may not include jfnk/gmres.hpp")
plant(${in_fpm} "#include <constitutive/elastic.hpp>"
      "a library may not include constitutive/elastic.hpp")
plant(${in_fpm} "#include \"wiring/scene.hpp\"" "a library may not include wiring/scene.hpp")
plant(${in_fpm} "#include <flann/flann.hpp>" "a library may not include flann/flann.hpp")
plant(${in_fpm} "#include <H5Cpp.h>" "a library may not include H5Cpp.h")
plant(${in_fpm} "#include <spdlog/spdlog.h>" "a library may not include spdlog/spdlog.h")
plant(${in_constitutive} "#include <boost/serialization/nvp.hpp>"
      "a library may not include boost/serialization/nvp.hpp")
plant(${in_fpm} "#include \"private.hpp\"" "a library may not include private.hpp")

# They neither print, nor read files, nor exit.
plant(${in_jfnk} "#include <iostream>\n" "a library may not include iostream")
plant(${in_jfnk} "#include <fstream>\n" "a library may not include fstream")
plant(${in_jfnk} "auto& f() { return std::cout; }"
      "a library may not print, read files or exit (std::cout)")
plant(${in_jfnk} "void f() { std::printf (\"\"); }"
      "a library may not print, read files or exit (printf)")
plant(${in_jfnk} "auto f() { return fopen(\"a\", \"r\"); }"
      "a library may not print, read files or exit (fopen)")
plant(${in_jfnk} "void f() { std::exit(1); }"
      "a library may not print, read files or exit (exit)")
plant(${in_jfnk} "void f() { std::abort(); }"
      "a library may not print, read files or exit (abort)")

# Each package has its place among the programs.
plant(apps/run/main.cpp "#include <H5Cpp.h>" "only apps/wiring may include H5Cpp.h")
plant(apps/run/main.cpp "#include <hdf5.h>" "only apps/wiring may include hdf5.h")
plant(apps/run/main.cpp "#include <toml++/toml.h>" "only apps/wiring may include toml++/toml.h")
plant(apps/limit/main.cpp "#include <spdlog/spdlog.h>"
      "only apps/wiring may include spdlog/spdlog.h")
plant(apps/wiring/checkpoint.cpp "#include <coin/IpTNLP.hpp>"
      "only apps/limit may include coin/IpTNLP.hpp")
plant(apps/run/main.cpp "#include <CGAL/Delaunay_mesher_2.h>"
      "only apps/limit may include CGAL/Delaunay_mesher_2.h")
plant(apps/wiring/checkpoint.cpp "#include <flann/flann.hpp>"
      "only libfpm may include flann/flann.hpp")
plant(apps/limit/main.cpp "#include \"run/run_scene.hpp\""
      "programs may not include each other (run/run_scene.hpp)")
make_clean_tree()
file(APPEND ${WORK}/apps/run/main.cpp "#include <jfnk/gmres.hpp>\n")
expect_exactly("" "a program that sees one library")
file(APPEND ${WORK}/apps/run/run_scene.hpp "#include <fpm/kernel.hpp>\n")
expect_exactly("apps/run: only apps/wiring may join libraries (jfnk, fpm)"
               "a program that joins two libraries")

# Everywhere.
plant(apps/run/run_scene.hpp "using namespace std;" "using namespace std in a header")
plant(tests/wiring/helpers.hpp "using\nnamespace wiring::detail;"
      "using namespace wiring::detail in a header")
plant(apps/run/main.cpp "#include \"../wiring/scene.hpp\""
      "includes by a path, not by a name (../wiring/scene.hpp)")

# A tree that lost a library is a mistake of the check, not a pass.
make_clean_tree()
file(REMOVE_RECURSE ${WORK}/libjfnk)
expect_exactly("libjfnk: has no sources to check" "a missing library")

file(REMOVE_RECURSE ${WORK})
