# SPDX-License-Identifier: Apache-2.0
# One folder of src/ is one static library; one folder of tests/ is one test program.

add_library(ridgeline_flags INTERFACE)
# GCC 12 warns falsely of overlap in std::string concatenation (GCC bug 105329).
target_compile_options(ridgeline_flags INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
                                                 $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(RIDGELINE_WERROR)
  target_compile_options(ridgeline_flags INTERFACE -Werror)
endif()
if(RIDGELINE_SANITIZE)
  add_compile_options(-fsanitize=${RIDGELINE_SANITIZE} -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${RIDGELINE_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_compile_options(-fno-sanitize=function)  # clang 14 compiles no coroutine (samplers) with it
  endif()
  # Eigen allocates in another way under the address sanitizer; the installed libraries (Ceres,
  # pagmo) free what we allocate, so ours has to be theirs.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

# Joins the sources of a target before they are compiled, if RIDGELINE_UNITY names its part.
function(ridgeline_unity target part)
  if(part IN_LIST RIDGELINE_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
  endif()
endfunction()

# ridgeline_add_module(NAME SOURCES a.cc ... [PUBLIC lib ...] [PRIVATE lib ...])
function(ridgeline_add_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(ridgeline_${name} STATIC ${ARG_SOURCES})
  add_library(ridgeline::${name} ALIAS ridgeline_${name})
  set_target_properties(ridgeline_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(
    ridgeline_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/ridgeline>)
  target_link_libraries(ridgeline_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  target_link_libraries(ridgeline_${name} PRIVATE $<BUILD_INTERFACE:ridgeline_flags>)
  ridgeline_unity(ridgeline_${name} ${name})
  set_property(GLOBAL APPEND PROPERTY RIDGELINE_MODULES ridgeline_${name})
endfunction()

# ridgeline_add_tests(NAME SOURCES a_test.cc ... [LIBS lib ...]): the program <name>_tests, its cases
# known to CTest one by one.
function(ridgeline_add_tests name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name}_tests ${ARG_SOURCES})
  target_link_libraries(${name}_tests PRIVATE ${ARG_LIBS} ridgeline_flags GTest::gtest GTest::gmock
                                              GTest::gtest_main)
  target_include_directories(${name}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests
                                                   ${PROJECT_BINARY_DIR}/generated)
  ridgeline_unity(${name}_tests ${name}_tests)
  include(GoogleTest)
  gtest_discover_tests(${name}_tests TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 120
                       PROPERTIES TIMEOUT 300)
endfunction()

# ridgeline_add_bench(NAME SOURCES a_bench.cc ... [LIBS lib ...])
function(ridgeline_add_bench name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} ridgeline_flags benchmark::benchmark
                                        benchmark::benchmark_main)
  target_include_directories(${name} PRIVATE ${PROJECT_BINARY_DIR}/generated)
endfunction()
