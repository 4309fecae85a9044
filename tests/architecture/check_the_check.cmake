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
  file(WRITE ${WORK}/apps/files/hdf5_file.cpp "#include <hdf5.h>\nusing namespace std;\n")
  file(WRITE ${WORK}/apps/model/model.hpp "#include <Eigen/Core>\n#include \"fpm/kernel.hpp\"\n")
  file(WRITE ${WORK}/apps/model/checkpoint.cpp
       "#include <boost/archive/text_oarchive.hpp>\n#include \"model/model.hpp\"\n"
       "#include \"record/lineage.hpp\"\n")
  file(WRITE ${WORK}/apps/equilibrium/instances/loops.cpp
       "#include \"model/model.hpp\"\n#include \"jfnk/residual.hpp\"\n")
  file(WRITE ${WORK}/apps/run/main.cpp "#include <iostream>\n#include \"run/run_scene.hpp\"\n")
  file(WRITE ${WORK}/apps/limit/solver/ipopt_solver.cpp "#include <coin/IpTNLP.hpp>\n")
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
plant(${in_fpm} "#include \"scene/scene.hpp\"" "a library may not include scene/scene.hpp")
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

# Each room of apps/ knows those that its row names: a sample of what must never be written there.
function(plant_include file include room)
  plant(apps/${file} "#include \"${include}\"" "${room}/ may not include ${include}")
endfunction()
plant_include(files/output_file.cpp program/exit_code.hpp files)
plant_include(files/output_file.cpp scene/scene.hpp files)
plant_include(tables/table.hpp scene/scene.hpp tables)
plant_include(tables/table.hpp files/file_error.hpp tables)
plant_include(program/progress.cpp record/curve.hpp program)
plant_include(scene/check.hpp program/logging.hpp scene)
plant_include(scene/check.hpp model/model.hpp scene)
plant_include(scene/check.hpp fpm/kernel.hpp scene)
plant_include(record/frames.hpp scene/scene.hpp record)
plant_include(record/frames.hpp model/state.hpp record)
plant_include(bounds/limit_check.cpp limit/report.hpp bounds)
plant_include(bounds/limit_check.cpp stepping/stepper.hpp bounds)
plant_include(model/state.hpp equilibrium/equilibrium.hpp model)
plant_include(model/state.hpp jfnk/solver.hpp model)
plant_include(model/state.hpp program/version.hpp model)
plant_include(shape/body.hpp scene/scene.hpp shape)
plant_include(equilibrium/equilibrium.cpp stepping/stepper.hpp equilibrium)
plant_include(equilibrium/equilibrium.cpp scene/scene.hpp equilibrium)
plant_include(equilibrium/instances/loops.cpp scene/scene.hpp equilibrium)
plant_include(stepping/stepper.cpp run/recorder.hpp stepping)
plant_include(stepping/stepper.cpp bounds/limit_check.hpp stepping)
plant_include(stepping/stepper.cpp constitutive/elastic.hpp stepping)
plant_include(run/run_scene.hpp jfnk/solver.hpp run)
plant_include(run/run_scene.hpp limit/report.hpp run)
plant_include(run/run_scene.hpp info/describe.hpp run)
plant_include(info/describe.cpp model/model.hpp info)
plant_include(info/describe.cpp fpm/kernel.hpp info)
plant_include(compare/source.cpp info/describe.hpp compare)
plant_include(compare/source.cpp constitutive/elastic.hpp compare)
plant_include(limit/mesh/mesh.hpp limit/problem/problem.hpp limit/mesh)
plant_include(limit/algebra/least_change.hpp limit/mesh/mesh.hpp limit/algebra)
plant_include(limit/problem/case.hpp limit/bracket/bracket.hpp limit/problem)
plant_include(limit/programme/lower_bound.cpp limit/solver/cone_solver.hpp limit/programme)
plant_include(limit/solver/cone_solver.hpp limit/problem/problem.hpp limit/solver)
plant_include(limit/certificate/lower_certificate.cpp limit/programme/lower_bound.hpp
              limit/certificate)
plant_include(limit/certificate/lower_certificate.cpp limit/solver/cone_solver.hpp
              limit/certificate)
plant_include(limit/bracket/bracket.cpp limit/ground/ground_mesh.hpp limit/bracket)
plant_include(limit/ground/ground_mesh.hpp limit/bracket/bracket.hpp limit/ground)
plant_include(limit/footing/scene_case.cpp model/model.hpp limit/footing)
plant_include(limit/report.hpp run/report.hpp limit)
plant_include(limit/report.hpp fpm/kernel.hpp limit)
plant_include(convergence/convergence.hpp campaign/campaign.hpp convergence)
plant_include(picture/picture.hpp study/report.hpp picture)
plant_include(campaign/campaign.cpp study/grid.hpp campaign)
plant_include(campaign/campaign.cpp run/run_scene.hpp campaign)
plant_include(study/study.cpp model/model.hpp study)
plant_include(material/path.cpp scene/scene.hpp material)
plant_include(material/element_test.cpp fpm/kernel.hpp material)
plant(apps/wiring/helpers.hpp "int f();" "lies in no room")

# And each package has its places.
function(plant_package file include package)
  plant(apps/${file} "#include <${include}>" "may not see ${package} (${include})")
endfunction()
plant_package(record/curve.cpp hdf5.h HDF5)
plant_package(run/main.cpp H5Cpp.h HDF5)
plant_package(scene/reader.cpp toml++/toml.h toml++)
plant_package(record/curve.cpp toml++/toml.h toml++)
plant_package(run/main.cpp spdlog/spdlog.h spdlog)
plant_package(scene/reader.cpp boost/program_options.hpp program_options)
plant_package(model/model.hpp boost/archive/text_oarchive.hpp archives)
plant_package(files/output_file.cpp nlohmann/json.hpp nlohmann-json)
plant_package(limit/bracket/bracket.cpp coin/IpTNLP.hpp Ipopt)
plant_package(limit/certificate/lower_certificate.cpp dmumps_c.h Ipopt)
plant_package(limit/ground/ground_case.cpp CGAL/Delaunay_mesher_2.h CGAL)
plant_package(model/checkpoint.cpp flann/flann.hpp FLANN)
plant_package(record/curve.cpp Eigen/Core Eigen)
plant_package(model/surface.cpp boost/geometry.hpp Boost.Geometry)
plant_package(shape/ring.cpp boost/polygon/voronoi.hpp Boost.Polygon)

# Every row of the table, as a whole: of all rooms, libraries and packages in one file, those that are
# not its own nor named are found, and no other.
set(header_of_HDF5 hdf5.h)
set(header_of_toml++ toml++/toml.h)
set(header_of_spdlog spdlog/spdlog.h)
set(header_of_program_options boost/program_options.hpp)
set(header_of_archives boost/archive/text_oarchive.hpp)
set(header_of_nlohmann-json nlohmann/json.hpp)
set(header_of_Ipopt IpTNLP.hpp)
set(header_of_CGAL CGAL/Delaunay_mesher_2.h)
set(header_of_FLANN flann/flann.hpp)
set(header_of_Eigen Eigen/Core)
set(header_of_Boost.Geometry boost/geometry.hpp)
set(header_of_Boost.Polygon boost/polygon/voronoi.hpp)
foreach(room IN LISTS rooms)
  make_clean_tree()
  set(text)
  set(expected)
  set(file apps/${room}/planted.cpp)
  foreach(other IN LISTS rooms ITEMS fpm constitutive jfnk)
    string(APPEND text "#include \"${other}/header.hpp\"\n")
    if(NOT other STREQUAL room AND NOT other IN_LIST may_include_of_${room})
      list(APPEND expected "${file}: ${room}/ may not include ${other}/header.hpp")
    endif()
  endforeach()
  foreach(package IN LISTS packages)
    string(APPEND text "#include <${header_of_${package}}>\n")
    if(NOT package IN_LIST sees_of_${room})
      list(APPEND expected "${file}: may not see ${package} (${header_of_${package}})")
    endif()
  endforeach()
  file(WRITE ${WORK}/${file} "${text}")
  expect_exactly("${expected}" "all at once in ${file}")
endforeach()

# Circles among components, through headers or sources, are named without those who only lead there.
make_clean_tree()
file(WRITE ${WORK}/apps/scene/a.hpp "#include \"scene/b.hpp\"\n")
file(WRITE ${WORK}/apps/scene/b.hpp "")
file(WRITE ${WORK}/apps/scene/b.cpp "#include \"scene/b.hpp\"\n#include \"scene/c.hpp\"\n")
file(WRITE ${WORK}/apps/scene/c.hpp "")
expect_exactly("" "a chain")
file(WRITE ${WORK}/apps/scene/c.cpp "#include \"scene/a.hpp\"\n")
file(WRITE ${WORK}/apps/scene/d.cpp "#include \"scene/a.hpp\"\n")
expect_exactly(
  "apps: these include each other in a circle: scene/a, scene/b, scene/c" "a circle")

# Everywhere.
plant(apps/run/run_scene.hpp "using namespace std;" "using namespace std in a header")
plant(tests/scene/helpers.hpp "using\nnamespace scene::detail;"
      "using namespace scene::detail in a header")
plant(apps/run/main.cpp "#include \"../scene/scene.hpp\""
      "includes by a path, not by a name (../scene/scene.hpp)")

# A tree that lost a library is a mistake of the check, not a pass.
make_clean_tree()
file(REMOVE_RECURSE ${WORK}/libjfnk)
expect_exactly("libjfnk: has no sources to check" "a missing library")

file(REMOVE_RECURSE ${WORK})
