# SPDX-License-Identifier: Apache-2.0
# Finds what the Python package needs, and says in one line whether it is built. A Python on the PATH
# without NumPy or headers goes behind the system's.
set(RIDGELINE_PYTHON AUTO CACHE STRING
    "Build the Python package: ON, OFF, or AUTO (where Python, NumPy and pybind11 are found)")
set(with_python FALSE)
if(RIDGELINE_PYTHON STREQUAL "AUTO" AND (RIDGELINE_SANITIZE OR NOT PROJECT_IS_TOP_LEVEL))
  message(STATUS "ridgeline: the Python package is not built (RIDGELINE_PYTHON=ON builds it)")
elseif(RIDGELINE_PYTHON)
  set(python_parts Interpreter Development.Module NumPy)
  find_package(Python 3.9 COMPONENTS ${python_parts} QUIET)
  if(NOT Python_FOUND AND EXISTS /usr/bin/python3)
    # With its own headers, not those found beside the first.
    get_cmake_property(found_before CACHE_VARIABLES)
    list(FILTER found_before INCLUDE REGEX "^_?Python_")
    foreach(variable IN LISTS found_before)
      unset(${variable} CACHE)
    endforeach()
    set(Python_EXECUTABLE /usr/bin/python3)
    find_package(Python 3.9 COMPONENTS ${python_parts} QUIET)
  endif()
  if(Python_FOUND)
    set(PYBIND11_FINDPYTHON ON)
    find_package(pybind11 2.10 CONFIG QUIET)
  endif()
  if(Python_FOUND AND pybind11_FOUND)
    set(with_python TRUE)
    message(STATUS "ridgeline: the Python package is built for ${Python_EXECUTABLE} "
                   "(${Python_VERSION})")
  elseif(RIDGELINE_PYTHON STREQUAL "AUTO")
    message(STATUS "ridgeline: built WITHOUT the Python package: it needs Python 3.9 with headers, "
                   "NumPy and pybind11 2.10 (packages python3-dev, python3-numpy, pybind11-dev)")
  else()
    message(FATAL_ERROR "RIDGELINE_PYTHON=${RIDGELINE_PYTHON}: Python 3.9 with headers, NumPy and "
                        "pybind11 2.10 are needed (packages python3-dev, python3-numpy, "
                        "pybind11-dev)")
  endif()
endif()
