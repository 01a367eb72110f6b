# SPDX-License-Identifier: Apache-2.0
# Every find_package of the project. RidgelineConfig.cmake.in repeats the ones that consumers need.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs calib3d video videoio ximgproc)
find_package(embree 3 REQUIRED)
find_package(GDAL 3.6 REQUIRED)
find_package(PROJ REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(Ceres 2.1 REQUIRED)
find_package(Pagmo REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(EXPAT REQUIRED)
find_package(ZLIB REQUIRED)
if(RIDGELINE_TESTS)
  find_package(GTest REQUIRED)
endif()
if(RIDGELINE_BENCHMARKS)
  find_package(benchmark REQUIRED)
  # The peer that city_bench and city_compare measure against (libcitygml-dev); they are left out
  # without it.
  find_path(CITYGML_INCLUDE_DIR citygml/citygml.h)
  find_library(CITYGML_LIBRARY citygml)
endif()
