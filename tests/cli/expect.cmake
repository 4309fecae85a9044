# cmake -DPROGRAM=... -DCODE=n -DOUTPUT=regex -P expect.cmake -- arguments ...
set(arguments "")
set(after FALSE)
foreach(i RANGE 1 ${CMAKE_ARGC})
  if(after AND i LESS CMAKE_ARGC)
    list(APPEND arguments "${CMAKE_ARGV${i}}")
  elseif("${CMAKE_ARGV${i}}" STREQUAL "--")
    set(after TRUE)
  endif()
endforeach()

execute_process(COMMAND ${PROGRAM} ${arguments} RESULT_VARIABLE code OUTPUT_VARIABLE output
                ERROR_VARIABLE output)
if(NOT "${code}" STREQUAL "${CODE}")
  message(FATAL_ERROR "exit code ${code}, not ${CODE}:\n${output}")
endif()
if(NOT "${output}" MATCHES "${OUTPUT}")
  message(FATAL_ERROR "the output does not match ${OUTPUT}:\n${output}")
endif()
