# What all tests run in, however ctest is called. Many run at once, and threads that look for work
# while they wait keep it from the others.
if(NOT DEFINED ENV{OMP_WAIT_POLICY})
  set(ENV{OMP_WAIT_POLICY} passive)
endif()
