# cmake -DPROGRAM=fpm-run -DSCENE=... -DFOLDER=... -P round_trip.cmake
# The effective scene is itself a scene, whose effective scene is the same text.
foreach(pass first second)
  execute_process(COMMAND ${PROGRAM} ${SCENE} --print-effective
                  OUTPUT_FILE ${FOLDER}/${pass}.toml RESULT_VARIABLE code ERROR_VARIABLE error)
  if(NOT code EQUAL 0 OR NOT error STREQUAL "")
    message(FATAL_ERROR "${pass}: exit code ${code}: ${error}")
  endif()
  set(SCENE ${FOLDER}/${pass}.toml)
endforeach()
file(READ ${FOLDER}/first.toml first)
file(READ ${FOLDER}/second.toml second)
if(first STREQUAL "" OR NOT first STREQUAL second)
  message(FATAL_ERROR "the effective scene changes when it is read back")
endif()
